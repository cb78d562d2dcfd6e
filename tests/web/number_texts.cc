// number_texts FILE
// Writes how numbers are formatted and read. It is compiled for both systems, whose texts are to be
// equal.

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "shared/core/file.h"
#include "shared/core/number_text.h"
#include "shared/core/random.h"

namespace lararium {
namespace {

template <typename T>
std::string Taken(std::string_view text, bool (&take)(std::string_view&, T&)) {
  T value = 7;
  const bool taken = take(text, value);
  return (taken ? "taken " : "left ") + FormatNumber(value) + " before '" + std::string(text) +
         "'\n";
}

std::string NumberTexts() {
  std::string out;
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const uint64_t bits = uint64_t{random.Next()} << 32 | random.Next();
    const auto high = static_cast<uint32_t>(bits >> 32);
    double wide;
    float narrow;
    std::memcpy(&wide, &bits, sizeof(wide));
    std::memcpy(&narrow, &high, sizeof(narrow));
    if (!std::isfinite(wide) || !std::isfinite(narrow)) {
      continue;
    }
    const auto decimal = static_cast<double>(static_cast<int64_t>(bits >> 40)) / 1000.0;
    for (const std::string& text : {FormatNumber(wide), FormatNumber(narrow), FormatNumber(decimal),
                                    FormatNumber(static_cast<float>(decimal))}) {
      out += text + " " + Taken<double>(text, TakeNumber) + Taken<float>(text, TakeNumber);
    }
  }
  for (const char* text :
       {"",      "-",   ".",   ".5",    "5.",   "-.5e1x", "1e",     "1e+",    "1e5",
        "1E-5 ", "+1",  " 1",  "--1",   "0x10", "1e999",  "-1e999", "1e-999", "00012",
        "1.2.3", "1,5", "1-2", "a.8p1", "ffg",  "p1",     "-1p-4"}) {
    out += Taken<double>(text, TakeNumber) + Taken<float>(text, TakeNumber) +
           Taken<double>(text, TakeHexNumber);
  }
  return out;
}

}  // namespace
}  // namespace lararium

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: number_texts FILE\n");
    return 2;
  }
  const lararium::Status status = lararium::WriteFileAtomically(argv[1], lararium::NumberTexts());
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
