// VTK unstructured grid: hexes, boundary quads; per cell the scaled Jacobian, the CAD face (0 inside) and the block. Arrays in base64.
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/quality.h"
#include "fem/formats.h"

namespace polycube {
namespace {

static_assert(std::endian::native == std::endian::little, "the header says so");

std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t block = 0;
    for (std::size_t k = 0; k < 3; ++k) block = block << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kDigits[block >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

template <typename T>
void append_array(std::string& text, const char* type, const char* attributes, const std::vector<T>& values) {
  const std::uint64_t bytes = values.size() * sizeof(T);
  append(text, "<DataArray type=\"%s\" %s format=\"binary\">\n", type, attributes);
  // One run of base64: VTK reads two as well, meshio with a Python of 2025 does not.
  std::vector<unsigned char> block(sizeof bytes + bytes);
  std::memcpy(block.data(), &bytes, sizeof bytes);
  if (bytes > 0) std::memcpy(block.data() + sizeof bytes, values.data(), bytes);
  text += base64(block);
  text += "\n</DataArray>\n";
}

}  // namespace

std::string vtu_text(const FemMesh& mesh) {
  constexpr std::uint8_t kQuad = 9, kHexahedron = 12, kQuadraticQuad = 23, kQuadraticHexahedron = 25;
  std::vector<double> points, quality;
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::uint8_t> types;
  std::vector<std::int32_t> faces;
  for (const Vec3& p : mesh.points) points.insert(points.end(), {p[0], p[1], p[2]});
  for (const auto& hex : mesh.hexes) {
    connectivity.insert(connectivity.end(), hex.begin(), hex.begin() + hex_nodes(mesh));
    offsets.push_back(std::ssize(connectivity));
    types.push_back(mesh.order == 2 ? kQuadraticHexahedron : kHexahedron);
    Hex corners;
    std::copy_n(hex.begin(), 8, corners.begin());
    quality.push_back(scaled_jacobian(mesh.points, corners));
    faces.push_back(0);
  }
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    connectivity.insert(connectivity.end(), mesh.quads[q].begin(), mesh.quads[q].begin() + quad_nodes(mesh));
    offsets.push_back(std::ssize(connectivity));
    types.push_back(mesh.order == 2 ? kQuadraticQuad : kQuad);
    quality.push_back(quality[mesh.quad_hex[q][0]]);
    faces.push_back(mesh.quad_face[q]);
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n";
  append(text, "<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"%zu\">\n<Points>\n", mesh.points.size(), types.size());
  append_array(text, "Float64", "Name=\"Points\" NumberOfComponents=\"3\"", points);
  text += "</Points>\n<Cells>\n";
  append_array(text, "Int64", "Name=\"connectivity\"", connectivity);
  append_array(text, "Int64", "Name=\"offsets\"", offsets);
  append_array(text, "UInt8", "Name=\"types\"", types);
  text += "</Cells>\n<CellData>\n";
  append_array(text, "Float64", "Name=\"ScaledJacobian\"", quality);
  append_array(text, "Int32", "Name=\"CadFace\"", faces);
  const auto append_by_hex = [&](const char* name, const std::vector<int>& of_hex) {
    if (of_hex.empty()) return;
    std::vector<std::int32_t> values(of_hex.begin(), of_hex.end());
    for (const auto& quad : mesh.quad_hex) values.push_back(of_hex[quad[0]]);
    append_array(text, "Int32", name, values);
  };
  append_by_hex("Name=\"Block\"", mesh.hex_block);
  append_by_hex("Name=\"CadSolid\"", mesh.hex_solid);
  text += "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return text;
}

}  // namespace polycube
