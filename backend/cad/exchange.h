// What STEP and IGES have in common: entities that refer to each other.
#pragma once

#include <XSControl_WorkSession.hxx>
#include <istream>
#include <string>

namespace polycube {

/// Parses the file (STEP from `stream` if that is given) into the session, ready for transfer. False where OCCT cannot. Throws InvalidInput for what OCCT's
/// own check and transfer would not survive: geometry that is built on itself, entities of one number, real numbers whose squares no double holds.
bool load_entities(const opencascade::handle<XSControl_WorkSession>& session, const std::string& path, std::istream* stream = nullptr);

}  // namespace polycube
