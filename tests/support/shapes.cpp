#include "support/shapes.h"

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <ShapeCustom.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Version.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <cmath>
#include <gp.hxx>
#include <gp_Circ.hxx>
#include <numbers>
#include <sstream>
#include <vector>
#if OCC_VERSION_HEX >= 0x070800
#include <StepData_StepModel.hxx>
#include <UnitsMethods.hxx>
#endif

namespace polycube::shapes {
namespace {

std::string text(const TopoDS_Shape& shape) {
  std::ostringstream stream;
  BRepTools::Write(shape, stream);
  return stream.str();
}

TopoDS_Shape parse(const std::string& brep) {
  std::istringstream stream(brep);
  TopoDS_Shape shape;
  BRepTools::Read(shape, stream, BRep_Builder());
  return shape;
}

/// The solid inside a Boolean operation's compound, without the seams of faces that continue each other.
TopoDS_Shape solid(const TopoDS_Shape& result) {
  ShapeUpgrade_UnifySameDomain unify(result);
  unify.Build();
  return TopExp_Explorer(unify.Shape(), TopAbs_SOLID).Current();
}

TopoDS_Shape block(const gp_Pnt& from, const gp_Pnt& to) { return BRepPrimAPI_MakeBox(from, to).Shape(); }

TopoDS_Face rectangle(double size, double lift) {
  BRepBuilderAPI_MakePolygon polygon;
  polygon.Add({0, 0, lift});
  polygon.Add({size, 0, lift});
  polygon.Add({size, size, lift});
  polygon.Add({0, size, lift});
  polygon.Close();
  return BRepBuilderAPI_MakeFace(polygon.Wire()).Face();
}

TopoDS_Shell five_faces(double size) {
  const TopoDS_Shape cube = block({0, 0, 0}, {size, size, size});
  TopoDS_Shell shell;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  int count = 0;
  for (TopExp_Explorer it(cube, TopAbs_FACE); it.More() && count < 5; it.Next(), ++count) builder.Add(shell, it.Current());
  return shell;
}

TopoDS_Shape turned_triangle(const gp_Pnt& a, const gp_Pnt& b, const gp_Pnt& c) {
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(a, b, c, true).Wire()).Face(), gp::OZ()).Shape();
}

TopoDS_Compound compound_of(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  for (const TopoDS_Shape& part : parts) builder.Add(result, part);
  return result;
}

TopTools_IndexedMapOfShape faces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return faces;
}

}  // namespace

std::string box(double x, double y, double z) { return text(block({0, 0, 0}, {x, y, z})); }
std::string cylinder(double radius, double height) { return text(BRepPrimAPI_MakeCylinder(radius, height).Solid()); }
std::string divided_rim(double radius, double height, double gap) {
  const double angle = gap / radius;
  TopTools_ListOfShape part, vertex;
  part.Append(BRepPrimAPI_MakeCylinder(radius, height).Shape());
  vertex.Append(BRepBuilderAPI_MakeVertex(gp_Pnt(radius * std::cos(angle), radius * std::sin(angle), height)).Shape());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(part);
  splitter.SetTools(vertex);
  splitter.Build();
  return text(TopExp_Explorer(splitter.Shape(), TopAbs_SOLID).Current());
}

std::string cone(double radius, double top_radius, double height) { return text(BRepPrimAPI_MakeCone(radius, top_radius, height).Solid()); }
std::string sphere(double radius) { return text(BRepPrimAPI_MakeSphere(radius).Solid()); }
std::string torus(double major, double minor) { return text(BRepPrimAPI_MakeTorus(major, minor).Solid()); }

std::string tube(double radius, double bore, double height) {
  return text(solid(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(radius, height).Shape(), BRepPrimAPI_MakeCylinder(bore, height).Shape()).Shape()));
}

std::string tube_sector(double radius, double bore, double height, double degrees) {
  const double angle = degrees * M_PI / 180;
  return text(solid(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(radius, height, angle).Shape(), BRepPrimAPI_MakeCylinder(bore, height).Shape()).Shape()));
}

std::string arched_block(double size, double radius) {
  return text(solid(BRepAlgoAPI_Cut(block({0, 0, 0}, {size, size, size}), BRepPrimAPI_MakeCylinder(radius, size).Shape()).Shape()));
}

std::string plate_with_hole(double x, double y, double z, double radius) {
  const gp_Ax2 axis({x / 2, y / 2, -z}, {0, 0, 1});
  return text(solid(BRepAlgoAPI_Cut(block({0, 0, 0}, {x, y, z}), BRepPrimAPI_MakeCylinder(axis, radius, 3 * z).Shape()).Shape()));
}

std::string l_bracket(double leg, double thickness, double width) {
  return text(solid(BRepAlgoAPI_Fuse(block({0, 0, 0}, {leg, width, thickness}), block({0, 0, 0}, {thickness, width, leg})).Shape()));
}

std::string notched_box(double size) {
  return text(solid(BRepAlgoAPI_Cut(block({0, 0, 0}, {size, size, size}), block({size / 2, size / 2, size / 2}, {2 * size, 2 * size, 2 * size})).Shape()));
}

std::string filleted_box(double size, double radius) {
  const TopoDS_Shape cube = block({0, 0, 0}, {size, size, size});
  BRepFilletAPI_MakeFillet fillet(cube);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(cube, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) fillet.Add(radius, TopoDS::Edge(edges(i)));
  return text(TopExp_Explorer(fillet.Shape(), TopAbs_SOLID).Current());
}

std::string box_with_square(double x, double y, double z, double from, double to) {
  BRepBuilderAPI_MakePolygon square(gp_Pnt(from, from, z), gp_Pnt(to, from, z), gp_Pnt(to, to, z), gp_Pnt(from, to, z), Standard_True);
  TopTools_ListOfShape boxes, tools;
  boxes.Append(block({0, 0, 0}, {x, y, z}));
  tools.Append(BRepBuilderAPI_MakeFace(square.Wire()).Shape());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(boxes);
  splitter.SetTools(tools);
  splitter.Build();
  return text(TopExp_Explorer(splitter.Shape(), TopAbs_SOLID).Current());
}

std::string chamfered_box(double size, double leg) {
  const TopoDS_Shape cube = block({0, 0, 0}, {size, size, size});
  BRepFilletAPI_MakeChamfer chamfer(cube);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(cube, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    const gp_Pnt a = BRep_Tool::Pnt(TopExp::FirstVertex(edge)), b = BRep_Tool::Pnt(TopExp::LastVertex(edge));
    if (a.X() == size && b.X() == size && a.Y() == size && b.Y() == size) chamfer.Add(leg, edge);
  }
  return text(TopExp_Explorer(chamfer.Shape(), TopAbs_SOLID).Current());
}

std::string pyramid(double side, double height) {
  BRepOffsetAPI_ThruSections sections(true, true);
  BRepBuilderAPI_MakePolygon square;
  const double s = side / 2;
  for (const gp_Pnt& p : {gp_Pnt(-s, -s, 0), gp_Pnt(s, -s, 0), gp_Pnt(s, s, 0), gp_Pnt(-s, s, 0)}) square.Add(p);
  square.Close();
  sections.AddWire(square.Wire());
  sections.AddVertex(BRepBuilderAPI_MakeVertex({0, 0, height}));
  sections.Build();
  return text(TopExp_Explorer(sections.Shape(), TopAbs_SOLID).Current());
}

std::string pointed(int sides, double radius, double height) {
  BRepOffsetAPI_ThruSections sections(true, true);
  BRepBuilderAPI_MakePolygon base;
  for (int i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / sides;
    base.Add({radius * std::cos(turn), radius * std::sin(turn), 0});
  }
  base.Close();
  sections.AddWire(base.Wire());
  sections.AddVertex(BRepBuilderAPI_MakeVertex({0, 0, height}));
  sections.Build();
  return text(TopExp_Explorer(sections.Shape(), TopAbs_SOLID).Current());
}

std::string tetrahedron(double edge) { return pointed(3, edge / std::sqrt(3), edge * std::sqrt(2.0 / 3)); }

std::string bevelled_box(double size, double leg) {
  const TopoDS_Shape cube = block({0, 0, 0}, {size, size, size});
  BRepFilletAPI_MakeChamfer chamfer(cube);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(cube, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) chamfer.Add(leg, TopoDS::Edge(edges(i)));
  return text(TopExp_Explorer(chamfer.Shape(), TopAbs_SOLID).Current());
}

std::string hollow_box(double size) {
  const double low = 0.3 * size, high = 0.7 * size;
  return text(solid(BRepAlgoAPI_Cut(block({0, 0, 0}, {size, size, size}), block({low, low, low}, {high, high, high})).Shape()));
}

std::string loft(double size, double height) {
  BRepOffsetAPI_ThruSections sections(true, false);
  BRepBuilderAPI_MakePolygon square;
  square.Add({-size / 2, -size / 2, 0});
  square.Add({size / 2, -size / 2, 0});
  square.Add({size / 2, size / 2, 0});
  square.Add({-size / 2, size / 2, 0});
  square.Close();
  sections.AddWire(square.Wire());
  BRepBuilderAPI_MakeWire circle;
  const gp_Circ curve(gp_Ax2({0, 0, height}, {0, 0, 1}), size / 3);
  for (int k = 0; k < 4; ++k) circle.Add(BRepBuilderAPI_MakeEdge(curve, (k - 2.5) * std::numbers::pi / 2, (k - 1.5) * std::numbers::pi / 2).Edge());
  sections.AddWire(circle.Wire());
  return text(TopExp_Explorer(sections.Shape(), TopAbs_SOLID).Current());
}

std::string turned(double radius, double height, double groove) {
  const double middle = height / 2;
  const gp_Pnt foot(0, 0, 0), out(radius, 0, 0), below(radius, 0, middle - groove), above(radius, 0, middle + groove), top(radius, 0, height),
      tip(0, 0, height);
  BRepBuilderAPI_MakeWire profile;
  profile.Add(BRepBuilderAPI_MakeEdge(foot, out).Edge());
  profile.Add(BRepBuilderAPI_MakeEdge(out, below).Edge());
  profile.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(below, gp_Pnt(radius - groove, 0, middle), above).Value()).Edge());
  profile.Add(BRepBuilderAPI_MakeEdge(above, top).Edge());
  profile.Add(BRepBuilderAPI_MakeEdge(top, tip).Edge());
  profile.Add(BRepBuilderAPI_MakeEdge(tip, foot).Edge());
  const TopoDS_Shape turned = BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(profile.Wire()).Face(), gp::OZ()).Shape();
  return text(ShapeCustom::ConvertToRevolution(turned));
}

std::string weld(double radius, double width, double height) { return text(turned_triangle({radius, 0, 0}, {radius + width, 0, 0}, {radius, 0, height})); }

std::string wedge_ring(double radius, double depth, double height) {
  return text(turned_triangle({radius, 0, 0}, {radius, 0, height}, {radius - depth, 0, height / 2}));
}

std::string forked_bar(double radius, double arm) {
  const TopoDS_Shape bar = BRepPrimAPI_MakeCylinder(gp_Ax2({0, 0, -2.5 * radius}, {0, 0, 1}), radius, 5 * radius).Shape();
  return text(solid(BRepAlgoAPI_Fuse(bar, BRepPrimAPI_MakeCylinder(gp_Ax2({0, 0, 0}, {1, 0, 1}), arm, 3.3 * radius).Shape()).Shape()));
}

std::string bored_web(double radius, double degrees) {
  const double half = radius * std::cos(degrees * std::numbers::pi / 180), wall = 1.6 * radius;
  const TopoDS_Shape plate = block({-wall, -2 * wall, 0}, {wall, 2 * wall, 2.7 * radius}), slot = block({-half, -wall, 0}, {half, wall, 1.6 * radius});
  const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(gp_Ax2({0, 0, 0.15 * radius}, {0, 0, 1}), radius, 3 * radius).Shape();
  return text(solid(BRepAlgoAPI_Cut(BRepAlgoAPI_Cut(plate, slot).Shape(), bore).Shape()));
}

std::string claws(double radius, double degrees) {
  const double disc = 0.35 * radius, gap = (90 - degrees) * std::numbers::pi / 180;
  const auto above = [&](double r, double from, double angle) {
    const gp_Ax2 axes({0, 0, disc}, {0, 0, 1}, {std::cos(from), std::sin(from), 0});
    return BRepPrimAPI_MakeCylinder(axes, r, radius, angle).Shape();
  };
  TopoDS_Shape rest = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(radius, 2 * disc).Shape(), above(0.5 * radius, 0, 2 * std::numbers::pi)).Shape();
  for (int k = 1; k <= 4; ++k) rest = BRepAlgoAPI_Cut(rest, above(1.5 * radius, k * std::numbers::pi / 2 - gap, gap)).Shape();
  return text(solid(rest));
}

std::string tangent_arm(double radius, double bore) {
  const TopoDS_Shape bar = BRepPrimAPI_MakeCylinder(radius, 2 * radius).Shape(), arm = block({0, -radius, 0.75 * radius}, {3 * radius, radius, 1.25 * radius});
  return text(solid(BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(bar, arm).Shape(), BRepPrimAPI_MakeCylinder(bore, 2 * radius).Shape()).Shape()));
}

std::string ribbed_plate(double width, double slope) {
  BRepBuilderAPI_MakePolygon rib;
  rib.Add({0, 0.4 * width, 0});
  rib.Add({width, 0.4 * width, 0});
  rib.Add({0, 0.4 * width, slope * width});
  rib.Close();
  const TopoDS_Shape wedge = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(rib.Wire()).Face(), gp_Vec(0, 0.2 * width, 0)).Shape();
  return text(solid(BRepAlgoAPI_Fuse(block({0, 0, -0.2 * width}, {width, width, 0}), wedge).Shape()));
}

std::string lens(double width, double height) {
  const double bulge = width / 2 * std::tan(std::numbers::pi / 12);  // arcs of 60 degrees
  const gp_Pnt left(-width / 2, 0, 0), right(width / 2, 0, 0), low(0, -bulge, 0), high(0, bulge, 0);
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(left, low, right).Value()));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(right, high, left).Value()));
  return text(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 0, height)));
}

std::string half_lens(double width, double height) {
  const double bulge = width / 2 * std::tan(std::numbers::pi / 12);
  const gp_Pnt left(-width / 2, 0, 0), right(width / 2, 0, 0), high(0, bulge, 0);
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(left, right));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(right, high, left).Value()));
  const TopoDS_Shape prism = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 0, height)).Shape();
  const gp_Ax2 axis({0, bulge / 2, 0}, {0, 0, 1});
  return text(solid(BRepAlgoAPI_Cut(prism, BRepPrimAPI_MakeCylinder(axis, bulge / 4, height).Shape()).Shape()));
}

std::string half_cylinder(double radius, double height) {
  const TopoDS_Shape tool = block({-2 * radius, -2 * radius, -height}, {2 * radius, 0, 2 * height});
  return text(solid(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(radius, height).Shape(), tool).Shape()));
}

std::string ribbed_cup(double radius) {
  const double wall = 0.1 * radius, height = 1.5 * radius, bore = radius - wall;
  const TopoDS_Shape hull = BRepPrimAPI_MakeCylinder(radius, height).Shape();
  const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(gp_Ax2({0, 0, wall}, {0, 0, 1}), bore, height).Shape();
  const TopoDS_Shape rib = block({-bore, -wall / 2, wall}, {bore, wall / 2, radius + wall});
  return text(solid(BRepAlgoAPI_Fuse(BRepAlgoAPI_Cut(hull, hole).Shape(), rib).Shape()));
}

std::string oblique_bore() {
  const double lean = std::numbers::pi / 9;
  const gp_Ax2 axis({16.5, 7, 14}, gp_Dir(std::sin(lean), 0, -std::cos(lean)));
  return text(solid(BRepAlgoAPI_Cut(block({0, 0, 0}, {20, 14, 12}), BRepPrimAPI_MakeCylinder(axis, 1.8, 40).Shape()).Shape()));
}

std::string pocket_beside_seam() {
  BRepBuilderAPI_MakePolygon triangle;
  for (const gp_Pnt& corner : {gp_Pnt(6, 0, 15), gp_Pnt(6, 4, 12), gp_Pnt(6, 4, 18)}) triangle.Add(corner);
  triangle.Close();
  const TopoDS_Shape cutter = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(triangle.Wire()).Face(), gp_Vec(10, 0, 0)).Shape();
  return text(solid(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(10, 30).Shape(), cutter).Shape()));
}

std::string drilled_block() {
  const auto half = [](double from, double to) {
    const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(gp_Ax2({10, 10, 8}, {0, 0, 1}), 1.2, 20).Shape();
    const TopoDS_Shape tip = BRepPrimAPI_MakeCone(gp_Ax2({10, 10, 8}, {0, 0, -1}), 1.2, 0, 0.72).Shape();
    return BRepAlgoAPI_Cut(BRepAlgoAPI_Cut(block({0, from, 0}, {20, to, 16}), hole).Shape(), tip).Shape();
  };
  return text(TopExp_Explorer(BRepAlgoAPI_Fuse(half(0, 10), half(10, 20)).Shape(), TopAbs_SOLID).Current());
}

std::string machined_box(double size, const std::vector<Prism>& cuts) {
  TopoDS_Shape result = block({0, 0, 0}, {size, size, size});
  for (const Prism& cut : cuts) {
    BRepBuilderAPI_MakePolygon polygon;
    for (const auto& [u, v] : cut.corners) {
      std::array<double, 3> at{};
      at[cut.axis] = cut.from;
      at[(cut.axis + 1) % 3] = u;
      at[(cut.axis + 2) % 3] = v;
      polygon.Add({at[0], at[1], at[2]});
    }
    polygon.Close();
    std::array<double, 3> along{};
    along[cut.axis] = cut.to - cut.from;
    const TopoDS_Shape cutter = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(along[0], along[1], along[2])).Shape();
    result = BRepAlgoAPI_Cut(result, cutter).Shape();
  }
  return text(solid(result));
}

std::string hole_through_slot() {
  std::vector<std::array<double, 2>> hexagon;
  for (int k = 0; k < 6; ++k) {
    const double angle = (4.6 + 60 * k) * std::numbers::pi / 180;
    hexagon.push_back({12.6 + 2 * std::cos(angle), 14.7 + 2 * std::sin(angle)});
  }
  return machined_box(20, {{1, {{2, 10}, {6, 10}, {6, 14}, {2, 14}}, -1, 21}, {2, hexagon, -1, 21}});
}

std::string slots_through_hole() {
  return machined_box(20, {{0, {{13.6, 9.1}, {6.4, 3.6}, {5.9, 13.5}}, -1, 21}, {1, {{7.9, 2.9}, {13.8, 2.9}, {13.8, 7.5}, {7.9, 7.5}}, -1, 21}});
}

std::string hole_past_chamfer(double past, double wider) {
  const double leg = 5.544, tip = leg + past;
  return machined_box(
      20, {{1, {{20 - leg, -.01}, {20.01, leg + .01}, {20.01, -.01}}, -1, 21}, {2, {{tip, 6.746}, {tip - 3.1, 7.87}, {tip - 1.1, 10.346 + wider}}, -1, 21}});
}

std::string hexagon_bolt(double width, double shank) {
  BRepBuilderAPI_MakePolygon hexagon;
  for (int k = 0; k < 6; ++k) {
    const double angle = (30 + 60 * k) * std::numbers::pi / 180, radius = width / std::sqrt(3.0);
    hexagon.Add(gp_Pnt(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  hexagon.Close();
  const double height = 0.4 * width, slope = std::tan(std::numbers::pi / 6);
  const TopoDS_Shape prism = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(hexagon.Wire()).Face(), gp_Vec(0, 0, height)).Shape();
  const TopoDS_Shape cone = BRepPrimAPI_MakeCone(width / 2 + height / slope, width / 2, height).Shape();
  TopoDS_Shape result = BRepAlgoAPI_Common(prism, cone).Shape();
  if (shank > 0) result = BRepAlgoAPI_Fuse(result, BRepPrimAPI_MakeCylinder(gp_Ax2({0, 0, 0}, {0, 0, -1}), width / 3, shank).Shape()).Shape();
  return text(solid(result));
}

std::string moved(const std::string& brep, double degrees, double x, double y, double z) {
  gp_Trsf turn, shift;
  turn.SetRotation(gp_Ax1({0, 0, 0}, {1, 2, 3}), degrees * std::numbers::pi / 180);
  shift.SetTranslation({x, y, z});
  return text(BRepBuilderAPI_Transform(parse(brep), shift * turn, true).Shape());
}

std::string scaled(const std::string& brep, double factor) {
  gp_Trsf scale;
  scale.SetScale({0, 0, 0}, factor);
  return text(BRepBuilderAPI_Transform(parse(brep), scale, true).Shape());
}

std::string loosened(const std::string& brep, double tolerance) {
  const TopoDS_Shape shape = parse(brep);
  const BRep_Builder builder;
  for (TopExp_Explorer e(shape, TopAbs_EDGE); e.More(); e.Next()) {
    builder.UpdateEdge(TopoDS::Edge(e.Current()), tolerance);
    for (TopExp_Explorer v(e.Current(), TopAbs_VERTEX); v.More(); v.Next()) builder.UpdateVertex(TopoDS::Vertex(v.Current()), tolerance);
  }
  return text(shape);
}

std::string compound(const std::string& a, const std::string& b) { return text(compound_of({parse(a), parse(b)})); }

std::string fused(const std::vector<std::string>& breps) {
  TopTools_ListOfShape arguments;
  for (const std::string& brep : breps) arguments.Append(parse(brep));
  BRepAlgoAPI_BuilderAlgo fuse;
  fuse.SetArguments(arguments);
  fuse.Build();
  return text(fuse.Shape());
}

std::string face_and_solid(const std::string& brep, int face) {
  const TopoDS_Shape whole = parse(brep);
  return text(compound_of({faces_of(whole)(face).Reversed(), whole}));
}

std::string taken_apart(const std::string& brep, double gap) {
  const TopTools_IndexedMapOfShape faces = faces_of(parse(brep));
  std::vector<TopoDS_Shape> parts;
  for (int i = 1; i <= faces.Extent(); ++i) {
    gp_Trsf motion;
    if (i == faces.Extent()) motion.SetTranslation({0, 0, gap});
    parts.push_back(BRepBuilderAPI_Transform(faces(i), motion, true).Shape());
  }
  return text(compound_of(parts));
}

void write_step(const std::string& brep, const std::string& path, const std::string& unit) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", unit.c_str());
  STEPControl_Writer writer;
#if OCC_VERSION_HEX >= 0x070800
  // It names the unit and leaves the numbers in mm otherwise.
  writer.Model()->SetWriteLengthUnit(UnitsMethods::GetLengthFactorValue(Interface_Static::IVal("write.step.unit")));
#endif
  writer.Transfer(parse(brep), STEPControl_AsIs);
  writer.Write(path.c_str());
  Interface_Static::SetCVal("write.step.unit", "MM");
}

void write_step_products(const std::vector<std::pair<std::string, std::string>>& named, const std::string& path) {
  STEPControl_Controller::Init();
  STEPControl_Writer writer;
  for (const auto& [name, brep] : named) {
    Interface_Static::SetCVal("write.step.product.name", name.c_str());
    writer.Transfer(parse(brep), STEPControl_AsIs);
  }
  writer.Write(path.c_str());
}

void write_iges(const std::string& brep, const std::string& path, const std::string& unit, bool solid) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer(unit.c_str(), solid ? 1 : 0);
  writer.AddShape(parse(brep));
  writer.ComputeModel();
  writer.Write(path.c_str());
}

std::string crossed_box(double size) {
  const double low = 0.3 * size, high = 0.7 * size;
  const TopoDS_Shape hull = block({0, 0, 0}, {size, size, size}), hole = block({high, low, low}, {1.2 * size, high, high});
  BRepBuilderAPI_MakeSolid solid;
  for (TopExp_Explorer shell(hull, TopAbs_SHELL); shell.More(); shell.Next()) solid.Add(TopoDS::Shell(shell.Current()));
  for (TopExp_Explorer shell(hole, TopAbs_SHELL); shell.More(); shell.Next()) solid.Add(TopoDS::Shell(shell.Current().Reversed()));
  return text(solid.Solid());
}

std::string open_box(double size) { return text(five_faces(size)); }
std::string open_solid(double size) { return text(BRepBuilderAPI_MakeSolid(five_faces(size)).Solid()); }
std::string loose_face(double size) { return text(rectangle(size, 0)); }

std::string flat_solid(double size) {
  const TopoDS_Shape face = rectangle(size, 0);
  TopoDS_Shell shell;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  builder.Add(shell, face);
  builder.Add(shell, face.Reversed());
  return text(BRepBuilderAPI_MakeSolid(shell).Solid());
}

}  // namespace polycube::shapes
