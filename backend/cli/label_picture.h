// A picture of a labelled part.
#pragma once

#include <string>

#include "pipeline/inspect.h"

namespace polycube {

struct PictureOptions {
  int size = 1400;            ///< pixels, width and height of the whole
  bool face_numbers = false;  ///< write FreeCAD's number on every CAD face that is seen
};

/// Writes a PNG of four views from alternating corners of a cube about the frame. Faces are coloured by label (key at the top), chart boundaries black,
/// CAD edges with feature charts white, CAD edges that are not captured dashed, turning points red, corners that no polycube has yellow, zigzags cyan.
/// Throws InvalidInput where the file cannot be written.
void write_picture(const std::string& path, const LabelledPart& part, const Inspection& inspection, const PictureOptions& options);

}  // namespace polycube
