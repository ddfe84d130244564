#pragma once
// An input of CONTACT for wheel on rail (module 1, NAME.inp) as the text of a case. Lengths in mm, forces in N, z down.
// [eve70a/CONTACT, user guide]
//
// CONTACT's y points to the right of the track, a case's to the field side: with s = -1 for a left wheel, 1 for a right
// one, Y of the tape circle from the middle of the wheelset, r its radius, Omega = s (VYAW + CURV VS),
//   phi = s ROLL,  psi = s YAW,  roll = -tan(phi),  yaw = tan(psi),  curve_radius = VS/Omega,
//   lateral_shift = s (Y_WS - DY) + Y (cos(phi) cos(psi) - 1) - r sin(phi),
//   creepage = 1 - (Omega Y - VPITCH r cos(psi))/VS,  lateral_creepage = s (VY - VROLL r)/VS - tan(psi),
// the creepages those of the wheel, for CONTACT turns the wheelset about its middle and a case about the tape circle.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace railstrata {

/// NAME.inp, or NAME.inp#3 of its third case.
struct ContactInputName {
  std::filesystem::path file;
  int number = 0;  ///< from 1; 0: the first of module 1
};
/// None of a file that is no input by its name.
std::optional<ContactInputName> contact_input_name(const std::filesystem::path& given);

struct ContactInput {
  std::string case_text;
  std::vector<std::string> notes;  ///< what was assumed or left out
};

/// The case of that number; values that it keeps are those of the cases before it. Throws CaseError with the lines of
/// what a case cannot say.
ContactInput read_contact_input(const std::string& text, const ContactInputName& name);

}  // namespace railstrata
