#include "cli/raster.h"

#include <png.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace polycube {
namespace {

// Strokes on a grid 4 wide and 6 high, y upwards.
const std::map<char, std::vector<std::vector<std::array<int, 2>>>>& strokes() {
  static const std::map<char, std::vector<std::vector<std::array<int, 2>>>> kStrokes{
      {'0', {{{0, 0}, {4, 0}, {4, 6}, {0, 6}, {0, 0}}}},
      {'1', {{{1, 5}, {2, 6}, {2, 0}}}},
      {'2', {{{0, 6}, {4, 6}, {4, 3}, {0, 3}, {0, 0}, {4, 0}}}},
      {'3', {{{0, 6}, {4, 6}, {4, 0}, {0, 0}}, {{0, 3}, {4, 3}}}},
      {'4', {{{0, 6}, {0, 3}, {4, 3}}, {{4, 6}, {4, 0}}}},
      {'5', {{{4, 6}, {0, 6}, {0, 3}, {4, 3}, {4, 0}, {0, 0}}}},
      {'6', {{{4, 6}, {0, 6}, {0, 0}, {4, 0}, {4, 3}, {0, 3}}}},
      {'7', {{{0, 6}, {4, 6}, {2, 0}}}},
      {'8', {{{0, 0}, {4, 0}, {4, 6}, {0, 6}, {0, 0}}, {{0, 3}, {4, 3}}}},
      {'9', {{{4, 3}, {0, 3}, {0, 6}, {4, 6}, {4, 0}, {0, 0}}}},
      {'+', {{{0, 3}, {4, 3}}, {{2, 1}, {2, 5}}}},
      {'-', {{{0, 3}, {4, 3}}}},
      {'X', {{{0, 0}, {4, 6}}, {{0, 6}, {4, 0}}}},
      {'Y', {{{0, 6}, {2, 3}, {4, 6}}, {{2, 3}, {2, 0}}}},
      {'Z', {{{0, 6}, {4, 6}, {0, 0}, {4, 0}}}},
  };
  return kStrokes;
}

}  // namespace

void Picture::dot(double x, double y, double radius, Colour c) {
  if (radius < 1) return set(static_cast<int>(x), static_cast<int>(y), c);
  for (int j = static_cast<int>(std::floor(y - radius)); j <= y + radius; ++j) {
    for (int i = static_cast<int>(std::floor(x - radius)); i <= x + radius; ++i) {
      if (std::hypot(i + 0.5 - x, j + 0.5 - y) <= radius) set(i, j, c);
    }
  }
}

void Picture::line(double x0, double y0, double x1, double y1, double radius, Colour c) {
  const int steps = 1 + static_cast<int>(std::hypot(x1 - x0, y1 - y0));
  for (int i = 0; i <= steps; ++i) dot(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps, radius, c);
}

double Picture::text(double x, double y, double height, double radius, const std::string& letters, Colour c) {
  const double unit = height / 6, start = x;
  for (char letter : letters) {
    const auto found = strokes().find(letter);
    if (found != strokes().end()) {
      for (const auto& stroke : found->second) {
        for (std::size_t i = 1; i < stroke.size(); ++i)
          line(x + unit * stroke[i - 1][0], y - unit * stroke[i - 1][1], x + unit * stroke[i][0], y - unit * stroke[i][1], radius, c);
      }
    }
    x += 6 * unit;
  }
  return x - start - 2 * unit;
}

void Picture::paste_half(const Picture& other, int x, int y) {
  for (int j = 0; j < other.height() / 2; ++j) {
    for (int i = 0; i < other.width() / 2; ++i) {
      int r = 0, g = 0, b = 0;
      for (int k = 0; k < 4; ++k) {
        const Colour c = other.at(2 * i + k % 2, 2 * j + k / 2);
        r += c.r;
        g += c.g;
        b += c.b;
      }
      set(x + i, y + j, {static_cast<std::uint8_t>((r + 2) / 4), static_cast<std::uint8_t>((g + 2) / 4), static_cast<std::uint8_t>((b + 2) / 4)});
    }
  }
}

bool Picture::write_png(const std::string& path) const {
  static_assert(sizeof(Colour) == 3);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  return png_image_write_to_file(&image, path.c_str(), 0, pixels_.data(), 0, nullptr) != 0;
}

View::View(Picture& picture, const Vec3& eye, const std::vector<Vec3>& points)
    : picture_(picture), depth_(static_cast<std::size_t>(picture.width()) * picture.height(), std::numeric_limits<float>::infinity()), ids_(depth_.size(), 0) {
  axes_.row(2) = eye.normalized();
  axes_.row(0) = Vec3::UnitZ().cross(eye).normalized();
  axes_.row(1) = axes_.row(2).cross(axes_.row(0));
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(axes_ * p);
    high = high.cwiseMax(axes_ * p);
  }
  centre_ = (low + high) / 2;
  const Vec3 extent = (high - low).cwiseMax(1e-300);
  scale_ = 0.92 * std::min(picture.width() / extent[0], picture.height() / extent[1]);
  slack_ = 0.004 * scale_ * extent.norm();
}

Vec3 View::to_pixel(const Vec3& p) const {
  const Vec3 q = scale_ * (axes_ * p - centre_);
  return {picture_.width() / 2.0 + q[0], picture_.height() / 2.0 - q[1], -q[2]};
}

void View::triangle(const std::array<Vec3, 3>& corners, Colour c, int id) {
  const std::array<Vec3, 3> p{to_pixel(corners[0]), to_pixel(corners[1]), to_pixel(corners[2])};
  const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  if (area == 0) return;
  const auto range = [&](int k, int limit) {
    const auto [low, high] = std::minmax({p[0][k], p[1][k], p[2][k]});
    return std::pair(std::max(0, static_cast<int>(std::floor(low - 0.5))), std::min(limit - 1, static_cast<int>(std::ceil(high + 0.5))));
  };
  const auto [x0, x1] = range(0, picture_.width());
  const auto [y0, y1] = range(1, picture_.height());
  // Border pixels count to both sides: no gaps between triangles.
  constexpr double kOver = -1e-9;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      std::array<double, 3> w{};
      for (int k = 0; k < 3; ++k) {
        const Vec3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
        w[k] = ((b[0] - a[0]) * (y + 0.5 - a[1]) - (b[1] - a[1]) * (x + 0.5 - a[0])) / area;
      }
      if (w[0] < kOver || w[1] < kOver || w[2] < kOver) continue;
      const auto depth = static_cast<float>(w[0] * p[0][2] + w[1] * p[1][2] + w[2] * p[2][2]);
      const std::size_t at = static_cast<std::size_t>(y) * picture_.width() + x;
      if (depth >= depth_[at]) continue;
      depth_[at] = depth;
      ids_[at] = id;
      picture_.set(x, y, c);
    }
  }
}

bool View::visible(const Vec3& pixel) const {
  const int x = static_cast<int>(pixel[0]), y = static_cast<int>(pixel[1]);
  if (x < 0 || y < 0 || x >= picture_.width() || y >= picture_.height()) return false;
  return pixel[2] <= depth_[static_cast<std::size_t>(y) * picture_.width() + x] + slack_;
}

void View::line(const Vec3& a, const Vec3& b, double radius, Colour c, double dash) {
  const Vec3 p = to_pixel(a), q = to_pixel(b);
  const int steps = 1 + static_cast<int>((q - p).head<2>().norm());
  for (int i = 0; i <= steps; ++i) {
    const Vec3 at = p + (q - p) * i / steps;
    // By place in the picture, not along the line: a CAD edge is many short lines.
    if (dash > 0 && static_cast<int>(std::floor((at[0] + at[1]) / dash)) % 2 != 0) continue;
    if (visible(at)) picture_.dot(at[0], at[1], radius, c);
  }
}

void View::dot(const Vec3& p, double radius, Colour c, Colour rim) {
  const Vec3 at = to_pixel(p);
  if (!visible(at)) return;
  picture_.dot(at[0], at[1], 1.5 * radius, rim);
  picture_.dot(at[0], at[1], radius, c);
}

}  // namespace polycube
