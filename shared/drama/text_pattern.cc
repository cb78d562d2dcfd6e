#include "shared/drama/text_pattern.h"

#include <string>

namespace lararium::drama {
namespace {

constexpr size_t kNoMatch = static_cast<size_t>(-1);
constexpr size_t kMaxRepeats = 200;  // Limits the recursion.

bool IsBetween(uint8_t c, char low, char high) {
  return c >= static_cast<uint8_t>(low) && c <= static_cast<uint8_t>(high);
}

// Whether c is in the class of the lower-case letter; nullopt: the class does not exist.
std::optional<bool> InClass(uint8_t c, char letter) {
  const bool lower = IsBetween(c, 'a', 'z');
  const bool upper = IsBetween(c, 'A', 'Z');
  const bool digit = IsBetween(c, '0', '9');
  const bool graphic = IsBetween(c, '!', '~');
  switch (letter) {
    case 'a':
      return lower || upper;
    case 'c':
      return c < 32 || c == 127;
    case 'd':
      return digit;
    case 'g':
      return graphic;
    case 'l':
      return lower;
    case 'p':
      return graphic && !lower && !upper && !digit;
    case 's':
      return c == ' ' || IsBetween(c, '\t', '\r');
    case 'u':
      return upper;
    case 'w':
      return lower || upper || digit;
    case 'x':
      return digit || IsBetween(c, 'a', 'f') || IsBetween(c, 'A', 'F');
    default:
      return std::nullopt;
  }
}

// The set of "%letter": a class, its complement, or the character itself.
std::bitset<256> EscapedSet(char letter) {
  const bool complement = letter >= 'A' && letter <= 'Z';
  const char lower = complement ? static_cast<char>(letter - 'A' + 'a') : letter;
  std::bitset<256> set;
  for (size_t c = 0; c < set.size(); ++c) {
    const std::optional<bool> in_class = InClass(static_cast<uint8_t>(c), lower);
    set[c] = in_class ? *in_class != complement : c == static_cast<uint8_t>(letter);
  }
  return set;
}

}  // namespace

class TextPattern::Compiler {
 public:
  explicit Compiler(std::string_view pattern) : pattern_(pattern) {}

  Result<TextPattern> Compile() {
    while (at_ < pattern_.size()) {
      LARARIUM_RETURN_IF_ERROR(ReadItem());
    }
    if (!open_.empty()) {
      return Malformed("a '(' is not closed");
    }
    return std::move(result_);
  }

 private:
  static Status Malformed(std::string_view what) {
    return Status::Error("malformed pattern", what);
  }

  bool Next(char c) const { return at_ + 1 < pattern_.size() && pattern_[at_ + 1] == c; }

  Status ReadItem() {
    const char c = pattern_[at_];
    if (c == '(') {
      return OpenCapture();
    }
    if (c == ')') {
      return CloseCapture();
    }
    if (c == '$' && at_ + 1 == pattern_.size()) {
      ++at_;
      Add(Kind::kEnd);
      return Status();
    }
    if (c == '%' && Next('b')) {
      return ReadBalance();
    }
    if (c == '%' && Next('f')) {
      at_ += 2;
      if (at_ >= pattern_.size() || pattern_[at_] != '[') {
        return Malformed("'[' is missing after '%f'");
      }
      return ReadSet(Add(Kind::kFrontier));
    }
    if (c == '%' && at_ + 1 < pattern_.size() && IsBetween(pattern_[at_ + 1], '0', '9')) {
      return ReadRepeatedCapture();
    }
    LARARIUM_RETURN_IF_ERROR(ReadSet(Add(Kind::kSet)));
    return ReadRepeat();
  }

  Item& Add(Kind kind) {
    result_.items_.emplace_back().kind = kind;
    return result_.items_.back();
  }

  Status OpenCapture() {
    if (result_.capture_count_ == kMaxCaptures) {
      return Malformed("more than 32 captures");
    }
    const bool is_position = Next(')');
    Add(is_position ? Kind::kPosition : Kind::kOpen).capture = result_.capture_count_;
    if (!is_position) {
      open_.push_back(result_.capture_count_);
    }
    ++result_.capture_count_;
    at_ += is_position ? 2 : 1;
    return Status();
  }

  Status CloseCapture() {
    if (open_.empty()) {
      return Malformed("a ')' closes nothing");
    }
    Add(Kind::kClose).capture = open_.back();
    open_.pop_back();
    ++at_;
    return Status();
  }

  Status ReadBalance() {
    if (at_ + 3 >= pattern_.size()) {
      return Malformed("'%b' needs two characters");
    }
    Item& item = Add(Kind::kBalance);
    item.open = static_cast<uint8_t>(pattern_[at_ + 2]);
    item.close = static_cast<uint8_t>(pattern_[at_ + 3]);
    at_ += 4;
    return Status();
  }

  Status ReadRepeatedCapture() {
    const auto capture = static_cast<size_t>(pattern_[at_ + 1] - '1');
    bool closed = capture < result_.capture_count_;
    for (const size_t open : open_) {
      closed = closed && open != capture;
    }
    if (!closed) {
      return Malformed("'%" + std::string(1, pattern_[at_ + 1]) + "' is no finished capture");
    }
    Add(Kind::kRepeatCapture).capture = capture;
    at_ += 2;
    return Status();
  }

  // Reads one character, class or [set].
  Status ReadSet(Item& item) {
    const char c = pattern_[at_++];
    if (c == '[') {
      return ReadBrackets(item);
    }
    if (c == '%') {
      if (at_ == pattern_.size()) {
        return Malformed("it ends with '%'");
      }
      item.set = EscapedSet(pattern_[at_++]);
    } else if (c == '.') {
      item.set.set();
    } else {
      item.set.set(static_cast<uint8_t>(c));
    }
    return Status();
  }

  Status ReadBrackets(Item& item) {
    const bool complement = at_ < pattern_.size() && pattern_[at_] == '^';
    at_ += complement ? 1 : 0;
    const size_t first = at_;
    // A ']' at the beginning is an ordinary character.
    while (at_ < pattern_.size() && (pattern_[at_] != ']' || at_ == first)) {
      if (pattern_[at_] == '%') {
        if (at_ + 1 == pattern_.size()) {
          break;
        }
        item.set |= EscapedSet(pattern_[at_ + 1]);
        at_ += 2;
      } else if (Next('-') && at_ + 2 < pattern_.size() && pattern_[at_ + 2] != ']') {
        for (int c = static_cast<uint8_t>(pattern_[at_]);
             c <= static_cast<uint8_t>(pattern_[at_ + 2]); ++c) {
          item.set.set(static_cast<size_t>(c));
        }
        at_ += 3;
      } else {
        item.set.set(static_cast<uint8_t>(pattern_[at_++]));
      }
    }
    if (at_ >= pattern_.size() || pattern_[at_] != ']') {
      return Malformed("a ']' is missing");
    }
    ++at_;
    if (complement) {
      item.set.flip();
    }
    return Status();
  }

  Status ReadRepeat() {
    const char c = at_ < pattern_.size() ? pattern_[at_] : '\0';
    if (c != '?' && c != '*' && c != '+' && c != '-') {
      return Status();
    }
    ++at_;
    if (++repeats_ > kMaxRepeats) {
      return Malformed("more than 200 repetitions");
    }
    if (c == '+') {  // x+ means xx*.
      result_.items_.push_back(result_.items_.back());
    }
    result_.items_.back().repeat = c == '?'   ? Repeat::kOptional
                                   : c == '-' ? Repeat::kFewest
                                              : Repeat::kMost;
    return Status();
  }

  std::string_view pattern_;
  size_t at_ = 0;
  std::vector<size_t> open_;  // Indices of open captures, innermost last.
  size_t repeats_ = 0;
  TextPattern result_;
};

// Backtracking search. There are no alternatives, so each path sets a capture before it uses it,
// and nothing has to be undone.
class TextPattern::Run {
 public:
  Run(const std::vector<Item>& items,
      std::string_view subject,
      int64_t& steps_left,
      std::vector<TextCapture>& captures)
      : items_(items), subject_(subject), steps_left_(steps_left), captures_(captures) {}

  // Returns the end of a match of the items from `index` on with the subject from s on.
  size_t Match(size_t index, size_t s) {
    for (; index < items_.size() && s != kNoMatch; ++index) {
      if (--steps_left_ < 0) {
        return kNoMatch;
      }
      const Item& item = items_[index];
      if (item.kind == Kind::kSet && item.repeat != Repeat::kOnce) {
        return MatchRepeated(item, index, s);
      }
      s = MatchOne(item, s);
    }
    return s;
  }

 private:
  bool Fits(const Item& item, size_t s) {
    --steps_left_;
    return s < subject_.size() && item.set[static_cast<uint8_t>(subject_[s])];
  }

  size_t MatchRepeated(const Item& item, size_t index, size_t s) {
    if (item.repeat == Repeat::kFewest) {
      for (;; ++s) {
        const size_t end = Match(index + 1, s);
        if (end != kNoMatch || steps_left_ < 0 || !Fits(item, s)) {
          return end;
        }
      }
    }
    const size_t most = item.repeat == Repeat::kOptional ? 1 : subject_.size() - s;
    size_t count = 0;
    while (count < most && Fits(item, s + count)) {
      ++count;
    }
    for (;; --count) {
      const size_t end = Match(index + 1, s + count);
      if (end != kNoMatch || steps_left_ < 0 || count == 0) {
        return end;
      }
    }
  }

  size_t MatchOne(const Item& item, size_t s) {
    switch (item.kind) {
      case Kind::kSet:
        return Fits(item, s) ? s + 1 : kNoMatch;
      case Kind::kOpen:
        captures_[item.capture] = {s, s, false};
        return s;
      case Kind::kPosition:
        captures_[item.capture] = {s, s, true};
        return s;
      case Kind::kClose:
        captures_[item.capture].end = s;
        return s;
      case Kind::kBalance:
        return MatchBalance(item, s);
      case Kind::kFrontier: {
        const uint8_t before = s == 0 ? 0 : static_cast<uint8_t>(subject_[s - 1]);
        const uint8_t here = s < subject_.size() ? static_cast<uint8_t>(subject_[s]) : 0;
        return !item.set[before] && item.set[here] ? s : kNoMatch;
      }
      case Kind::kRepeatCapture:
        return MatchCapture(captures_[item.capture], s);
      case Kind::kEnd:
        return s == subject_.size() ? s : kNoMatch;
    }
    return kNoMatch;
  }

  size_t MatchBalance(const Item& item, size_t s) {
    if (s >= subject_.size() || static_cast<uint8_t>(subject_[s]) != item.open) {
      return kNoMatch;
    }
    size_t depth = 1;
    while (++s < subject_.size() && --steps_left_ >= 0) {
      const auto c = static_cast<uint8_t>(subject_[s]);
      if (c == item.close) {
        if (--depth == 0) {
          return s + 1;
        }
      } else if (c == item.open) {
        ++depth;
      }
    }
    return kNoMatch;
  }

  size_t MatchCapture(const TextCapture& capture, size_t s) {
    const size_t size = capture.is_position ? 0 : capture.end - capture.begin;
    steps_left_ -= static_cast<int64_t>(size);
    const bool same = !capture.is_position && steps_left_ >= 0 &&
                      subject_.substr(s, size) == subject_.substr(capture.begin, size);
    return same ? s + size : kNoMatch;
  }

  const std::vector<Item>& items_;
  std::string_view subject_;
  int64_t& steps_left_;
  std::vector<TextCapture>& captures_;
};

Result<TextPattern> TextPattern::Compile(std::string_view pattern) {
  return Compiler(pattern).Compile();
}

std::optional<size_t> TextPattern::MatchAt(std::string_view subject,
                                           size_t begin,
                                           int64_t& steps_left,
                                           std::vector<TextCapture>& captures) const {
  captures.assign(capture_count_, TextCapture());
  const size_t end = Run(items_, subject, steps_left, captures).Match(0, begin);
  if (end == kNoMatch || steps_left < 0) {
    return std::nullopt;
  }
  return end;
}

}  // namespace lararium::drama
