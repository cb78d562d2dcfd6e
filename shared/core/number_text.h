#pragma once

// Numbers in texts of programs: always with a point, without spaces or a plus sign.

#include <string>
#include <string_view>

namespace lararium {

// Reads the finite number that `text` begins with and removes it from there. Returns false, without
// a change, if there is none or if it is too large or too small.
bool TakeNumber(std::string_view& text, float& value);
bool TakeNumber(std::string_view& text, double& value);
// Hexadecimal digits, with a fraction and a binary exponent if they follow, without 0x.
bool TakeHexNumber(std::string_view& text, double& value);

// Returns the shortest text from which exactly this number is read.
std::string FormatNumber(float value);
std::string FormatNumber(double value);

}  // namespace lararium
