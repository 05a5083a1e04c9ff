// A part of one solid or of several, and where they touch.
#pragma once

#include <string>
#include <vector>

#include "cad/cad.h"

namespace polycube {

struct FileShape;

/// Two solids that touch over an area.
struct Interface {
  std::array<int, 2> solids{0, 0};        ///< ascending, from 1: Solid1
  std::array<std::vector<int>, 2> faces;  ///< CAD faces of each that touch the other, ascending; the same number where the solids share the face
  double area = 0;                        ///< mm^2
};

/// The solids of a part, in the order of FreeCAD's names Solid1, Solid2 ... Faces, edges and vertices of all of them have the numbers of the whole shape as
/// read, so that one shared by two solids has one number.
struct Assembly {
  std::vector<CadModel> solids;
  std::vector<std::string> labels;      ///< per solid: of the object or product that it comes from, or empty
  std::vector<Interface> interfaces;    ///< ascending by solids
  std::vector<std::string> warnings{};  ///< one line each, of the whole; those of a solid are its own

  /// As CadModel reads a part, but of as many solids as it has. Throws InvalidInput; also where two solids overlap, with their names and the common volume.
  static Assembly read(const std::string& path, const ReadOptions& options = {}, const Monitor& monitor = Monitor());
  static Assembly from_brep(const std::string& text, const ReadOptions& options = {}, const Monitor& monitor = Monitor());

  /// "Solid2", with its label where it has one: Solid2 "Pin".
  std::string name(int solid) const;
  double diagonal() const;         ///< of the bounding box of all, mm
  double volume() const;           ///< mm^3
  std::vector<int> faces() const;  ///< numbers of all solids' faces, ascending
  std::vector<int> edges() const;
  std::vector<int> vertices() const;
  std::vector<std::string> all_warnings() const;  ///< of the whole and of its solids

 private:
  static Assembly of(const FileShape& read, const ReadOptions& options, const Monitor& monitor);
};

}  // namespace polycube
