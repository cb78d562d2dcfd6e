#include "editor/text/foreign_text.h"

#include <unicode/ucnv.h>
#include <unicode/ucsdet.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "shared/core/plain_text.h"
#include "shared/core/utf8.h"

namespace lararium::editor {
namespace {

constexpr size_t kMaxBytes = size_t{64} << 20;
constexpr const char* kWestern = "windows-1252";  // Contains ISO-8859-1.

struct Close {
  void operator()(UConverter* converter) const { ucnv_close(converter); }
  void operator()(UCharsetDetector* detector) const { ucsdet_close(detector); }
};

// Control characters other than those of lines and tabs do not occur in texts.
bool HasControls(std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const uint32_t c = NextCharacter(text, at);
    const bool layout = c == '\n' || c == '\t' || c == '\f' || c == 0x1A;  // 0x1A ends DOS files.
    if ((c < 0x20 && !layout) || (c >= 0x7F && c < 0xA0)) {
      return true;
    }
  }
  return false;
}

// UTF-8 in which only a few bytes are wrong, such as a file that was cut off or joined from two.
// nullopt if the text is rather in another encoding.
std::optional<ForeignText> Repair(std::string_view bytes) {
  size_t right = 0;
  size_t wrong = 0;
  size_t first_wrong = 0;  // Offset.
  std::string text;
  for (size_t at = 0; at < bytes.size();) {
    const size_t from = at;
    const uint32_t c = NextCharacter(bytes, at);
    AppendCharacter(c, text);
    const bool bad = c == 0xFFFD && bytes.substr(from, at - from) != "\xEF\xBF\xBD";
    first_wrong = bad && wrong == 0 ? from : first_wrong;
    wrong += bad ? 1 : 0;
    right += !bad && c >= 0x80 ? 1 : 0;
  }
  if (right < 4 * wrong) {
    return std::nullopt;
  }
  const auto line =
      std::count(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(first_wrong), '\n') + 1;
  return ForeignText{std::move(text), "line " + std::to_string(line) +
                                          ": holds bytes that are not UTF-8; correct the letter "
                                          "that is shown as \xEF\xBF\xBD"};
}

// nullopt if the encoding is not known or the bytes are not a text in it.
std::optional<std::string> Convert(const std::string& bytes, const char* encoding) {
  UErrorCode error = U_ZERO_ERROR;
  const std::unique_ptr<UConverter, Close> converter(ucnv_open(encoding, &error));
  ucnv_setToUCallBack(converter.get(), UCNV_TO_U_CALLBACK_STOP, nullptr, nullptr, nullptr, &error);
  if (U_FAILURE(error)) {
    return std::nullopt;
  }
  std::u16string wide(bytes.size() + 1, u'\0');
  const int32_t length =
      ucnv_toUChars(converter.get(), wide.data(), static_cast<int32_t>(wide.size()), bytes.data(),
                    static_cast<int32_t>(bytes.size()), &error);
  if (U_FAILURE(error)) {
    return std::nullopt;
  }
  wide.resize(static_cast<size_t>(length));
  std::optional<std::string> text = Utf8FromUtf16(wide);
  return text && !HasControls(*text) ? std::move(text) : std::nullopt;
}

// The first of ICU's proposals that the bytes are a text in, and the name of the encoding.
std::optional<std::pair<std::string, std::string>> Guess(const std::string& bytes) {
  UErrorCode error = U_ZERO_ERROR;
  const std::unique_ptr<UCharsetDetector, Close> detector(ucsdet_open(&error));
  int32_t count = 0;
  ucsdet_setText(detector.get(), bytes.data(), static_cast<int32_t>(bytes.size()), &error);
  const UCharsetMatch** matches = ucsdet_detectAll(detector.get(), &count, &error);
  for (int32_t i = 0; i <= count; ++i) {
    const char* name =
        i < count && U_SUCCESS(error) ? ucsdet_getName(matches[i], &error) : kWestern;
    const std::string_view proposed = name;
    // PlainText() has read Unicode already. IBM's encodings are those of mainframes.
    if (proposed.starts_with("UTF-") || proposed.starts_with("IBM")) {
      continue;
    }
    name = proposed == "ISO-8859-1" ? kWestern : name;
    if (std::optional<std::string> text = Convert(bytes, name)) {
      return std::pair(*std::move(text), std::string(name));
    }
  }
  return std::nullopt;
}

// Length of the blank that `text` begins with, or ends with; 0 if there is none.
size_t BlankAt(std::string_view text, bool front) {
  for (const std::string_view blank : {" ", "\t", "\n", "\r", "\xC2\xA0"}) {
    if (front ? text.starts_with(blank) : text.ends_with(blank)) {
      return blank.size();
    }
  }
  return 0;
}

}  // namespace

std::string_view TrimBlanks(std::string_view text) {
  while (const size_t length = BlankAt(text, true)) {
    text.remove_prefix(length);
  }
  while (const size_t length = BlankAt(text, false)) {
    text.remove_suffix(length);
  }
  return text;
}

Result<ForeignText> DecodeText(std::string_view bytes,
                               const std::string& where,
                               const std::string& declared) {
  if (bytes.size() > kMaxBytes) {
    return Status::Error(where, "is longer than 64 MiB", "split it");
  }
  ForeignText read{PlainText(std::string(bytes)), ""};
  if (read.text.find('\0') != std::string::npos) {
    return Status::Error(where, "is not a text: it holds a zero byte");
  }
  if (IsUtf8(read.text)) {
    return read;
  }
  if (std::optional<std::string> text =
          declared.empty() ? std::nullopt : Convert(read.text, declared.c_str())) {
    read.text = *std::move(text);
    return read;
  }
  if (std::optional<ForeignText> repaired = Repair(read.text)) {
    return *std::move(repaired);
  }
  auto guess = Guess(read.text);
  if (!guess) {
    return Status::Error(where, "is in an encoding that is not known", "save it as UTF-8");
  }
  read.text = std::move(guess->first);
  read.note = "is not UTF-8 and was read as " + guess->second +
              "; if letters are wrong, save it as UTF-8 in the program that wrote it";
  return read;
}

}  // namespace lararium::editor
