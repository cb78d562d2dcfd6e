#include "shared/drama/lua_literals.h"

#include <utility>

namespace lararium::drama {
namespace {

using Kind = LuaToken::Kind;

constexpr const char* kWhatCanStand =
    "only numbers, texts, true, false and tables are allowed here";

}  // namespace

bool LuaLiterals::Fail(const LuaToken& token, std::string problem) {
  problem_ = {token.begin, token.kind == Kind::kBad ? token.problem : std::move(problem)};
  return false;
}

bool LuaLiterals::Value(int depth, Json& value, size_t& end) {
  const LuaToken first = token_;
  end = first.end;
  if (first.Is('{')) {
    return Table(depth, value, end);
  }
  if (first.Is('-')) {
    Step();
    if (token_.kind != Kind::kNumber) {
      return Fail(first, kWhatCanStand);
    }
    value = -*NumberOf(Text(token_));
    end = token_.end;
  } else if (first.kind == Kind::kNumber) {
    value = *NumberOf(Text(first));
  } else if (first.kind == Kind::kText) {
    const auto text = TextOf(Text(first));
    if (!text) {
      return Fail(first, "this text has an escape that Lua does not know");
    }
    value = *text;
  } else if (first.kind == Kind::kName && (Text(first) == "true" || Text(first) == "false")) {
    value = Text(first) == "true";
  } else {
    return Fail(first, kWhatCanStand);
  }
  Step();
  return true;
}

bool LuaLiterals::Table(int depth, Json& value, size_t& end) {
  if (depth >= kMaxDepth) {
    return Fail(token_, "tables are nested too deeply");
  }
  const LuaToken open = token_;
  Json list = Json::array();
  Json fields = Json::object();
  const bool read = Entries(end, [&](LuaEntry& entry) {
    Json inner;
    if (!Value(depth + 1, inner, entry.value_end)) {
      return false;
    }
    if (entry.key.empty()) {
      list.push_back(std::move(inner));
    } else {
      fields[entry.key] = std::move(inner);
    }
    return true;
  });
  if (read && !list.empty() && !fields.empty()) {
    return Fail(open, "either all entries of a table have names or none");
  }
  value = list.empty() ? std::move(fields) : std::move(list);
  return read;
}

bool LuaLiterals::Key(LuaEntry& entry) {
  entry.begin = token_.begin;
  if (token_.Is('[')) {
    Step();
    if (token_.kind != Kind::kText) {
      return Fail(token_, "only a text can be a key");
    }
    entry.key = TextOf(Text(token_)).value_or("");
    Step();
    if (!token_.Is(']')) {
      return Fail(token_, "a ']' is missing");
    }
    Step();
    if (!token_.Is('=')) {
      return Fail(token_, "a '=' is missing");
    }
    Step();
  } else if (token_.kind == Kind::kName) {
    const LuaToken name = token_;
    const LuaTokens before = tokens_;
    Step();
    if (token_.Is('=')) {
      entry.key = std::string(Text(name));
      Step();
    } else {
      tokens_ = before;
      token_ = name;
    }
  }
  entry.value_begin = token_.begin;
  return true;
}

bool LuaLiterals::Separator(const LuaToken& open) {
  if (token_.Is(',') || token_.Is(';')) {
    Step();
    return true;
  }
  if (token_.kind == Kind::kEnd) {
    return Fail(open, "this brace is never closed");
  }
  return token_.Is('}') || Fail(token_, kWhatCanStand);
}

std::vector<LuaEntry> EntriesOf(std::string_view text, size_t offset, bool with_values) {
  std::vector<LuaEntry> entries;
  LuaLiterals literals(text, offset);
  size_t end = 0;
  literals.Entries(end, [&](LuaEntry& entry) {
    Json value;
    if (!literals.Value(0, value, entry.value_end)) {
      return false;
    }
    if (with_values) {
      entry.value = std::move(value);
    }
    const LuaToken& next = literals.token();
    entry.separator = next.Is(',') || next.Is(';') ? next.begin : 0;
    entries.push_back(std::move(entry));
    return true;
  });
  return entries;
}

}  // namespace lararium::drama
