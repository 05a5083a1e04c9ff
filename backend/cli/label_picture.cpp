#include "cli/label_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/raster.h"
#include "core/charts.h"
#include "core/error.h"

namespace polycube {
namespace {

constexpr Colour kPaper{255, 255, 255}, kInk{20, 20, 20}, kWhite{255, 255, 255}, kRed{220, 20, 30}, kYellow{255, 225, 0}, kCyan{0, 200, 230};
// Every other corner of a cube: each direction is seen from at least one side, from two mostly.
const std::array<Vec3, 4> kEyes{Vec3(1, -1.3, 0.9), Vec3(-1, 1.3, 0.9), Vec3(1.3, 1, -0.9), Vec3(-1.3, -1, -0.9)};

Colour label_paint(int label) {
  const auto [r, g, b] = label_colour(label);
  return {r, g, b};
}

Colour shaded(Colour c, double light) {
  const auto channel = [&](std::uint8_t v) { return static_cast<std::uint8_t>(std::lround(v * (0.62 + 0.38 * light))); };
  return {channel(c.r), channel(c.g), channel(c.b)};
}

class Painter {
 public:
  Painter(const LabelledPart& part, const Inspection& inspection, const PictureOptions& options)
      : mesh_(part.tets), part_(part), inspection_(inspection), numbers_(options.face_numbers), side_(options.size / 2), stroke_(options.size / 700.0) {
    for (const Vec3& p : mesh_.points) points_.push_back(part.labelling.frame * p);
    neighbours_ = triangle_neighbours(mesh_.triangles);
    std::vector<int> used;
    for (const Triangle& t : mesh_.triangles) used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (int n : used) surface_.push_back(points_[n]);
  }

  // One view at twice the size.
  Picture paint(const Vec3& eye) const {
    Picture picture(2 * side_, 2 * side_, kPaper);
    View view(picture, eye, surface_);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const std::array<Vec3, 3> corners{points_[a], points_[b], points_[c]};
      const double light = std::abs((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized().dot(eye.normalized()));
      view.triangle(corners, shaded(label_paint(part_.labelling.label[t]), light), mesh_.triangle_face[t]);
    }
    draw_lines(view);
    if (numbers_) draw_numbers(picture, view);
    draw_axes(picture, eye);
    return picture;
  }

 private:
  void draw_lines(View& view) const {
    std::vector<int> capture;
    for (const FeatureEdge& e : part_.features.edges) {
      capture.resize(std::max<std::size_t>(capture.size(), static_cast<std::size_t>(e.edge) + 1), -1);
      capture[e.edge] = static_cast<int>(e.capture);
    }
    for (std::size_t s = 0; s < mesh_.segments.size(); ++s) {
      const int e = mesh_.segment_edge[s];
      if (e >= static_cast<int>(capture.size()) || capture[e] <= static_cast<int>(EdgeCapture::kBoundary)) continue;
      const Vec3 &a = points_[mesh_.segments[s][0]], &b = points_[mesh_.segments[s][1]];
      const bool feature = capture[e] == static_cast<int>(EdgeCapture::kFeature);
      view.line(a, b, 1.3 * stroke_, kWhite);
      if (!feature) view.line(a, b, 1.3 * stroke_, kInk, 7 * stroke_);
    }
    for (int t = 0; t < static_cast<int>(neighbours_.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int n = neighbours_[t][k];
        if (n < t || inspection_.chart[n] == inspection_.chart[t]) continue;
        view.line(points_[mesh_.triangles[t][k]], points_[mesh_.triangles[t][(k + 1) % 3]], 1.6 * stroke_, kInk);
      }
    }
    for (int n : inspection_.zigzags) view.dot(points_[n], 3 * stroke_, kCyan, kInk);
    for (int n : inspection_.bad_corners) view.dot(points_[n], 5.5 * stroke_, kYellow, kInk);
    for (int n : inspection_.turning_points) view.dot(points_[n], 5.5 * stroke_, kRed, kWhite);
  }

  // On the pixel of each face that is nearest to the middle of its pixels.
  void draw_numbers(Picture& picture, const View& view) const {
    const int faces = *std::max_element(mesh_.triangle_face.begin(), mesh_.triangle_face.end());
    std::vector<std::array<double, 3>> sums(faces + 1, {0, 0, 0});
    const auto each_pixel = [&](const auto& work) {
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          if (const int f = view.id(x, y); f > 0) work(f, x, y);
        }
      }
    };
    each_pixel([&](int f, int x, int y) {
      sums[f][0] += x;
      sums[f][1] += y;
      sums[f][2] += 1;
    });
    std::vector<std::array<double, 3>> best(faces + 1, {0, 0, std::numeric_limits<double>::infinity()});
    each_pixel([&](int f, int x, int y) {
      const double d = std::hypot(x - sums[f][0] / sums[f][2], y - sums[f][1] / sums[f][2]);
      if (d < best[f][2]) best[f] = {static_cast<double>(x), static_cast<double>(y), d};
    });
    const double height = 16 * stroke_;
    for (int f = 1; f <= faces; ++f) {
      if (sums[f][2] < 40) continue;
      const std::string text = std::to_string(f);
      const double left = best[f][0] - height * static_cast<double>(text.size()) / 2 + height / 6, base = best[f][1] + height / 2;
      picture.text(left, base, height, 2.6 * stroke_, text, kWhite);
      picture.text(left, base, height, 1.2 * stroke_, text, kInk);
    }
  }

  void draw_axes(Picture& picture, const Vec3& eye) const {
    const double length = 60 * stroke_, x = 80 * stroke_, y = picture.height() - 80 * stroke_;
    const Vec3 right = Vec3::UnitZ().cross(eye).normalized(), up = eye.normalized().cross(right);
    for (int k = 0; k < 3; ++k) {
      const double u = x + length * right[k], v = y - length * up[k];
      picture.line(x, y, u, v, 2.5 * stroke_, label_paint(2 * k));
      picture.text(x + 1.25 * length * right[k] - 6 * stroke_, y - 1.25 * length * up[k] + 8 * stroke_, 16 * stroke_, 1.5 * stroke_, std::string(1, "XYZ"[k]),
                   kInk);
    }
  }

  const TetMesh& mesh_;
  const LabelledPart& part_;
  const Inspection& inspection_;
  bool numbers_;
  int side_;                            // pixels of a view
  double stroke_;                       // pixels at twice the size
  std::vector<Vec3> points_, surface_;  // in the frame
  std::vector<std::array<int, 3>> neighbours_;
};

}  // namespace

void write_picture(const std::string& path, const LabelledPart& part, const Inspection& inspection, const PictureOptions& options) {
  const int side = options.size / 2, key = options.size / 28;
  Picture picture(2 * side, 2 * side + key, kPaper);
  const Painter painter(part, inspection, options);
  for (int i = 0; i < 4; ++i) picture.paste_half(painter.paint(kEyes[i]), i % 2 * side, key + i / 2 * side);
  Picture names(4 * side, 2 * key, kPaper);
  for (int label = 0; label < 6; ++label) {
    const double x = (label + 0.2) * 4 * side / 6;
    names.line(x + 0.6 * key, key, x + 1.8 * key, key, 0.6 * key, label_paint(label));
    names.text(x + 2.8 * key, 1.5 * key, key, 0.08 * key, label_name(label), kInk);
  }
  picture.paste_half(names, 0, 0);
  if (!picture.write_png(path)) throw InvalidInput("cannot write " + path);
}

}  // namespace polycube
