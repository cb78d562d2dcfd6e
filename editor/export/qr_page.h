#pragma once

// A page to be printed and put up at a place: what visitors see there, and the code that opens it.

#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::exporter {

// The address as a QR code (ISO/IEC 18004), with the empty border that readers need.
Result<std::string> MakeQrCodeSvg(const std::string& address);

// HTML without other files. languages: tags of those in which the page says what to do; of those
// that it does not know, and if there are none, it says it in English.
Result<std::string> MakeQrPage(const std::string& title,
                               const std::string& address,
                               std::span<const std::string> languages);

}  // namespace lararium::exporter
