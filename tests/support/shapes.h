// Small solids for tests, made by OCCT, as BREP text for CadModel::from_brep. Lengths in mm.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace polycube::shapes {

std::string box(double x, double y, double z);                                       ///< a corner at the origin
std::string cylinder(double radius, double height);                                  ///< about +Z from the origin
std::string divided_rim(double radius, double height, double gap);                   ///< the cylinder, a second vertex on its upper rim so far from the seam
std::string cone(double radius, double top_radius, double height);                   ///< top_radius 0: with its tip
std::string sphere(double radius);                                                   ///< centre at the origin
std::string torus(double major, double minor);                                       ///< about +Z, centre at the origin
std::string tube(double radius, double bore, double height);                         ///< about +Z from the origin
std::string tube_sector(double radius, double bore, double height, double degrees);  ///< from +X about +Z from the origin
std::string arched_block(double size, double radius);                                ///< cube less a quarter of a cylinder about its edge on the Z axis
std::string plate_with_hole(double x, double y, double z, double radius);            ///< box with a through bore along Z in its middle
std::string l_bracket(double leg, double thickness, double width);                   ///< L in the XZ plane, extruded along Y; one concave edge
std::string notched_box(double size);                                                ///< cube minus a corner cube of half its size
std::string filleted_box(double size, double radius);                                ///< cube with all twelve edges rounded
std::string chamfered_box(double size, double leg);                                  ///< cube with one edge along Z cut at 45 degrees
std::string pyramid(double side, double height);                                     ///< square base in z = 0 about the origin
std::string pointed(int sides, double radius, double height);                        ///< pyramid over a regular polygon about the origin, a corner on +X
std::string tetrahedron(double edge);                                                ///< regular
std::string bevelled_box(double size, double leg);  ///< cube with all twelve edges cut at 45 degrees: a triangle at every corner
std::string hollow_box(double size);                ///< cube with a cubic void: two shells
std::string loft(double size, double height);       ///< square to circle: ruled B-spline sides
std::string turned(double radius, double height,
                   double groove);  ///< shaft turned from a profile, all faces surfaces of revolution, a half-round groove about it
std::string weld(double radius, double width,
                 double height);  ///< ring about Z on z = 0, a right triangle turned, its legs on the plane and towards the axis
std::string wedge_ring(double radius, double depth, double height);  ///< ring about Z whose outside is a cylinder, its section a triangle with the tip inside
std::string forked_bar(double radius, double arm);                   ///< cylinder about Z, a thinner one leaving its middle at 45 degrees to +X, +Z
std::string bored_web(double radius, double degrees);  ///< plate, a slot along Y from below, a bore about Z from above all but through, wider than the slot:
                                                       ///< two segments of its floor stay, arcs of twice `degrees`
std::string claws(double radius, double degrees);      ///< disc on z = 0, on it four claws as wide, flush with its rim, each from an axis on
std::string tangent_arm(double radius, double bore);   ///< tube about +Z, a plate as wide as the tube leaving its middle along +X: cusps
std::string ribbed_plate(double width,
                         double slope);              ///< plate with a rib along all of it, a right triangle that ends flush, its hypotenuse steep by slope : 1
std::string lens(double width, double height);       ///< prism along Z over two arcs that meet at 60 degrees, `width` apart along X
std::string half_lens(double width, double height);  ///< one of the arcs and its chord, a bore along Z
std::string half_cylinder(double radius, double height);  ///< cut by the plane y = 0, y >= 0 stays

std::string ribbed_cup(double radius);  ///< a rib as thin as the wall across it; the bore's seam ends in the middle of the rib's upper end

std::string oblique_bore();  ///< box of 20 x 14 x 12, a bore 20 degrees off Z comes out of its side x = 20 and leaves a wedge there
std::string box_with_square(double x, double y, double z, double from, double to);  ///< a square from (from, from) to (to, to) drawn on its top
std::string pocket_beside_seam();  ///< cylinder of radius 10 and height 30 about Z; the border of a triangular pocket touches its seam in a vertex
std::string drilled_block();  ///< 20 x 20 x 16, a hole of radius 1.2 with a drill's tip from above; cut in two at y = 10 and put together: its faces are halves

/// A cutter: a polygon across one axis, its corners by the two axes that follow (of y: z and x), drawn out along it.
struct Prism {
  int axis = 2;
  std::vector<std::array<double, 2>> corners;
  double from = 0, to = 0;
};
std::string machined_box(double size, const std::vector<Prism>& cuts);  ///< cube with a corner at the origin, less the cuts
std::string hole_through_slot();   ///< cube of 20, a slot along Y, a hexagonal hole along Z that breaks through its wall: two tips of 25 degrees on the slot's
                                   ///< floor and ceiling
std::string slots_through_hole();  ///< cube of 20, a triangular hole along X, a slot along Y through its edge
std::string hexagon_bolt(double width, double shank);  ///< width across flats, which the chamfer's cone touches; head alone where the shank has no length
std::string hole_past_chamfer(double past,
                              double wider);  ///< cube of 20, a chamfer, a triangular hole along Z (wider at its far end) whose edge is past the chamfer's

/// The shape turned by `degrees` about the direction (1, 2, 3) and moved by (x, y, z).
std::string moved(const std::string& brep, double degrees, double x, double y, double z);
/// Scaled about the origin.
std::string scaled(const std::string& brep, double factor);
/// The shape with this tolerance on its edges, as files with loose tolerances have it; the geometry stays.
std::string loosened(const std::string& brep, double tolerance);
/// One compound of both.
std::string compound(const std::string& a, const std::string& b);
/// One compound of the solids that their general fuse leaves: where they touch they share faces.
std::string fused(const std::vector<std::string>& breps);

/// A compound of one of the solid's faces (FreeCAD's number) and then the solid itself, which shares it.
std::string face_and_solid(const std::string& brep, int face);
/// A compound of copies of the solid's faces, none of which shares an edge with another; the last one is moved by `gap` along +Z.
std::string taken_apart(const std::string& brep, double gap = 0);

/// Files; `unit` as OCCT names it: "MM", "INCH", "M". The shape's numbers are mm.
void write_step(const std::string& brep, const std::string& path, const std::string& unit = "MM");
/// Each solid a product of that name.
void write_step_products(const std::vector<std::pair<std::string, std::string>>& named, const std::string& path);
/// `solid`: as a solid with topology (entity 186), else as trimmed surfaces.
void write_iges(const std::string& brep, const std::string& path, const std::string& unit = "MM", bool solid = false);

/// A cube whose cubic void sticks out of its side x = size: every face is sound, the shells cross.
std::string crossed_box(double size);

/// Not solids, for refusals.
std::string open_box(double size);    ///< shell of five faces
std::string open_solid(double size);  ///< a solid of that shell
std::string loose_face(double size);
std::string flat_solid(double size);  ///< a solid whose faces all lie in one plane

}  // namespace polycube::shapes
