#pragma once

// SHA-256 (FIPS 180-4).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lararium::bundle {

using Sha256 = std::array<uint8_t, 32>;

Sha256 ComputeSha256(std::span<const std::byte> bytes);

// Formats and parses 64 lower-case hexadecimal digits.
std::string FormatSha256(const Sha256& hash);
std::optional<Sha256> ParseSha256(std::string_view text);

}  // namespace lararium::bundle
