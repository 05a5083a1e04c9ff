// Arrays by name in one file, as numpy.load() reads it.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/types.h"

namespace polycube {

/// Collects copies of arrays; write() makes the file. Elements are int32 and float64, rows follow each other.
class Npz {
 public:
  void add(const std::string& name, const std::vector<int>& values) { add(name, values, {values.size()}); }
  void add(const std::string& name, const std::vector<double>& values) { add(name, values, {values.size()}); }
  /// The first `columns` of every row: an array of two dimensions. A row is a std::array or a Vec3.
  template <typename Row>
  void add_rows(const std::string& name, const std::vector<Row>& rows, std::size_t columns) {
    std::vector<std::remove_cvref_t<decltype(rows[0][0])>> flat;
    flat.reserve(rows.size() * columns);
    for (const Row& row : rows)
      for (std::size_t k = 0; k < columns; ++k) flat.push_back(row[k]);
    add(name, flat, {rows.size(), columns});
  }
  /// Throws InvalidInput where the file cannot be written.
  void write(const std::string& path) const;

 private:
  void add(const std::string& name, const std::vector<int>& flat, const std::vector<std::size_t>& shape);
  void add(const std::string& name, const std::vector<double>& flat, const std::vector<std::size_t>& shape);
  std::vector<std::pair<std::string, std::string>> files_;  ///< name and content
};

}  // namespace polycube
