// Orthographic drawing of triangles, lines and dots with hidden surfaces removed; PNG.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"

namespace polycube {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// Width x height pixels, row by row from the top.
class Picture {
 public:
  Picture(int width, int height, Colour background) : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height, background) {}
  int width() const { return width_; }
  int height() const { return height_; }
  Colour at(int x, int y) const { return pixels_[index(x, y)]; }
  void set(int x, int y, Colour c) {
    if (x >= 0 && y >= 0 && x < width_ && y < height_) pixels_[index(x, y)] = c;
  }
  /// A filled disc; a radius below 1 is one pixel.
  void dot(double x, double y, double radius, Colour c);
  void line(double x0, double y0, double x1, double y1, double radius, Colour c);
  /// Digits, + - X Y Z in strokes; (x, y) is the lower left corner, `height` that of a letter. Returns the width.
  double text(double x, double y, double height, double radius, const std::string& letters, Colour c);
  /// Copies `other` with its upper left corner at (x, y), every 2 x 2 pixels of it made one.
  void paste_half(const Picture& other, int x, int y);
  /// False where the file cannot be written.
  bool write_png(const std::string& path) const;

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }
  int width_, height_;
  std::vector<Colour> pixels_;
};

/// One view of a scene. Points are given in the scene's coordinates, pixels are (right, down), depth grows away from the eye.
class View {
 public:
  /// Looks along -`eye` with +Z up; the box of `points` fills the picture but for a margin.
  View(Picture& picture, const Vec3& eye, const std::vector<Vec3>& points);
  /// `id` is kept per pixel, 0 is the background.
  void triangle(const std::array<Vec3, 3>& corners, Colour c, int id);
  /// Drawn where it is not hidden by a triangle. `dash`: pixels on and off in turn, 0 for a solid line.
  void line(const Vec3& a, const Vec3& b, double radius, Colour c, double dash = 0);
  void dot(const Vec3& p, double radius, Colour c, Colour rim);
  Vec3 to_pixel(const Vec3& p) const;
  int id(int x, int y) const { return ids_[static_cast<std::size_t>(y) * picture_.width() + x]; }

 private:
  bool visible(const Vec3& pixel) const;
  Picture& picture_;
  Mat3 axes_;  // rows: right, up, towards the eye
  Vec3 centre_;
  double scale_, slack_;
  std::vector<float> depth_;
  std::vector<int> ids_;
};

}  // namespace polycube
