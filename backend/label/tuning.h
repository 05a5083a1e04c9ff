// What the stage label chose; what the words mean: core/tuned.h.
#pragma once

#include <array>
#include <numbers>

#include "core/tuned.h"

namespace polycube {

struct LabelTuning {
  /// Cosine, 15 degrees: a plane as near as this to an axis has the label of that axis. Guess.
  double aligned_cosine = 0.966;
  /// Cosine, 10 degrees: a face whose normals are as near as this to their mean is as good as a plane. Guess.
  double flat_cosine = 0.985;
  /// Cosine, 37 degrees: a cone whose normals are as near as this to its axis is blunt. Guess.
  double blunt_cosine = 0.8;
  /// What normals are stretched by along the axis that a chamfer shall have: one of 45 degrees becomes one of 29. Guess.
  double chamfer_turn = 1.8;
  /// Cosine of 60 degrees: a plane whose normal is further from an axis than this is no chamfer to it. Guess.
  double chamfer_from = 0.5;
  /// Cosine of 30 degrees: nor is one nearer than this. Guess.
  double chamfer_to = 0.866;
  /// Radians off straight from which labels change cheaply where two faces meet. Guess.
  double sharp_bend = std::numbers::pi / 6;
  /// Of its face's largest piece: a smaller piece of a face is no region of its own. Guess.
  double small_share = 0.04;
  /// Mean edges: with narrow regions, unless it is as wide as this. Guess.
  double narrow = 1.5;
  /// Divisions of oblique planes tried for one labelling. Guess.
  int most_divisions = 60;
  /// Where the rise of strictness begins. Guess.
  double first_strictness = 10;
  /// Share of an axis in its normal from which on a plane takes that axis's label. Guess.
  double least_share = 0.2;
  /// A face whose normals are all within this of their mean, along any axis, is none that bends: 6 degrees. Guess.
  double least_turn = 0.1;
  /// Where a bent face is divided, as shares of its extent. Theory: in the middle for a lens, near an end for the trailing edge of a wing.
  std::array<double, 5> bent_shares{0.5, 0.3, 0.7, 0.15, 0.85};
  /// Of its extent: what a bent face leaves at either end for two more labels, where the face opposite is a plane that may have but one. Guess.
  double bent_ends = 0.25;
  /// Cosine, 60 degrees: two CAD edges that meet in a tip, both nearer than this to the axis of a boundary that goes forth on one and back on the other, make a
  /// turning point that no map opens, however short they are; smooth edges run flat there. Guess.
  double steep = 0.5;
  /// Of the noise: what a boundary goes back at such a tip at least, for rounding is no reversal. Guess.
  double real_share = 0.01;
  /// Share of its label's direction in a region's normal below which it folds: 84 degrees off. Guess.
  double least_facing = 0.1;
  /// What such a region weighs: as much as a bad corner. Guess.
  double fold_score = 6;
  /// Of its CAD face: what a chart has of a face is a sliver below this share, and may face anywhere. Guess.
  double sliver = 0.04;
  /// Of the extent of a plane: a gap between CAD vertices from which on it may be divided there; nearer to a vertex the cut would move off. Guess.
  double least_gap = 0.1;
  /// Radians: generators of a barrel nearer to each other are one. Guess.
  double near_generators = std::numbers::pi / 36;
  /// Of the axis of a barrel in a direction across it. Guess.
  double across = 0.1;
  /// Radians of the normals of a bent face that keeps one label. Theory: over the 45 degrees that a quarter of a cylinder has.
  double fillets_whole = 0.96;
  /// Strictness of the strict variants. Guess.
  double strict = 1000;
  /// What a CAD edge without feature charts weighs against faults, of which a turning point weighs 3. Guess.
  double lost_feature = 3;
  /// Compactness of two variants. Guess.
  std::array<double, 2> compactness{3.0, 0.3};
  /// Price of changing the constant axis once along an edge, of its length. Theory: low enough that a circle becomes four arcs, which saves 0.08 of its length
  /// a change, high enough that a gently bent edge stays one piece.
  double turn_price = 0.04;
  /// Of the extent of a run along an edge: with a smaller change its axis is constant. Guess.
  double level = 1e-3;
  /// Radians: frames nearer to each other are one. Guess.
  double same_frame = 0.1;
  /// Mean of a bent face's normals, of one: below, it bends too far to have one label in any frame. Theory: an arc of 160 degrees.
  double bisected = 0.7;
  /// Mean square of the normals of a face that bends round one axis along that axis, and below which it does not bend. Guess.
  double off_plane = 0.01;
  /// Of the corners of charts where a part is smooth, those on bent faces that one label could have: with fewer another frame is not tried. Guess.
  double bent_corners = 0.25;
  /// Cosine of 85 degrees: a face with a normal nearer to an axis shows towards it. Guess.
  double towards = 0.087;
  /// Cosine of 100 degrees: one with a normal beyond shows against it. Guess.
  double against = -0.174;
  /// Cosine, 5 degrees: planes and axes of barrels further off the axes of the frame may be halved. Guess.
  double level_cosine = 0.996;
  /// Of a face's extent: a cut nearer to a CAD vertex moves on, for through the vertex it would leave open which side that is on. Guess.
  double off_vertex = 0.04;
  /// Of the extent: how far it moves. Guess.
  double aside = 0.15;
  /// Moves of the search for valid labels. Guess.
  int max_moves = 400;
  /// Of the edge that crosses a border: a point nearer to the border is put on it. Guess.
  double snap = 0.2;
  /// The smallest piece of an edge that is cut, of the edge. Guess.
  double thinnest = 0.05;
  /// Times the way that a border is off where it has to end: over so much it bends there. Guess.
  double bend_length = 5;
  /// Mean edges over which it does at least. Guess.
  double bend_edges = 2;
  /// Mean edges within which a border is looked for about the place where it ended before. Guess.
  double stray = 6;
  /// Triangles of a chart that is a sliver however large they are. Guess.
  int stray_triangles = 4;
  /// Of its CAD face: a chart below this and the next is a sliver. Guess.
  double stray_share = 0.02;
  /// Mean edges squared. Guess.
  double stray_area = 4;
  /// Triangles that an edge along a barrel has room for beside it. Guess.
  double room_triangles = 2;
  /// Radians, at least. Guess.
  double least_room = 10 * (std::numbers::pi / 180);
  /// Radians, at most. Guess.
  double most_room = 25 * (std::numbers::pi / 180);
  /// Of the room: within this the line at 45 degrees is too close. Guess.
  double close = 0.5;
  /// Radians beyond the line at 45 degrees up to which an edge belongs to the side it comes from. Guess.
  double beyond = 30 * (std::numbers::pi / 180);
  /// Radians: an edge that spans less runs along the barrel. Guess.
  double straight = 5 * (std::numbers::pi / 180);
  /// Radians, 20 degrees: the half of an arc round a barrel that with one other edge bounds a face, from which on its ends take other labels. Guess.
  double least_segment = std::numbers::pi / 9;
  /// Radians from an edge along a barrel: whether the barrel is there tells on which side of the edge it lies. Guess.
  double beside = 0.01;
  /// Of the way there: a point nearer to the barrel is on it. Guess.
  double on_barrel = 0.2;
  /// Radians to both sides in which the line is looked for. Guess.
  double line_step = 3 * (std::numbers::pi / 180);
  /// Halvings of that. Theory: down to nothing.
  int bisections = 40;
  /// Samples of an edge along a barrel. Guess.
  int samples = 65;
  /// Radians of the normals of a face that keeps one label (LabelOptions). Guess.
  double widest_bend = 0.5;
  /// Energy that one violation is worth (LabelOptions). Guess.
  double strictness = 100;

  POLYCUBE_ENTRIES(aligned_cosine, flat_cosine, blunt_cosine, chamfer_turn, chamfer_from, chamfer_to, sharp_bend, small_share, narrow, most_divisions,
                   first_strictness, least_share, least_turn, bent_shares, bent_ends, steep, real_share, least_facing, fold_score, sliver, least_gap,
                   near_generators, across, fillets_whole, strict, lost_feature, compactness, turn_price, level, same_frame, bisected, off_plane, bent_corners,
                   towards, against, level_cosine, off_vertex, aside, max_moves, snap, thinnest, bend_length, bend_edges, stray, stray_triangles, stray_share,
                   stray_area, room_triangles, least_room, most_room, close, beyond, straight, least_segment, beside, on_barrel, line_step, bisections, samples,
                   widest_bend, strictness)
};

inline constexpr const LabelTuning& kLabelTuning = tuning_in_force<LabelTuning>;

}  // namespace polycube
