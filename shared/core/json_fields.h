#pragma once

// One description of a document's fields, which serves reading, checking and writing. For each type
// a free function beside the type names its fields once:
//
//   void DescribeFields(Fields& fields, ClipDocument& clip) {
//     fields.Text("name", clip.name);
//     fields.Flag(Optional("loops", clip.loops), clip.loops);
//   }
//
// ParseFields<ClipDocument>(view) and FormatFields(clip) apply it. While writing, nothing is
// changed; a description that changes values itself does so only where Fields::reading().

#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "shared/core/status.h"

namespace lararium {

class JsonView;

// Addresses a field of an object by its name, or an entry of a list by its index. The name must
// outlive the description.
struct FieldKey {
  FieldKey(const char* key) : name(key) {}       // NOLINT: converts on purpose
  FieldKey(std::string_view key) : name(key) {}  // NOLINT: converts on purpose
  explicit FieldKey(size_t entry) : index(entry) {}

  std::string_view name;
  size_t index = 0;      // Used if the name is empty.
  bool required = true;  // Reading fails if a required field is missing.
  bool written = true;   // Writing leaves out a field for which this is false.
};

// A field that the file may lack, so that the value keeps its default. The field is written only if
// `written` is true.
inline FieldKey Optional(std::string_view name, bool written = true) {
  FieldKey key(name);
  key.required = false;
  key.written = written;
  return key;
}

// The fields of one object. Reading keeps the first error, after which all calls do nothing; the
// texts of errors name the file and the field, as those of JsonView do.
class Fields {
 public:
  Fields() = default;
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;
  virtual ~Fields() = default;

  virtual bool reading() const = 0;
  // While reading: the file and the path of the object within it. While writing: "".
  virtual std::string where() const = 0;
  // The same for a field of the object or an entry of the list.
  virtual std::string where(const FieldKey& key) = 0;
  // While reading: whether the object has the field. While writing: `written`. The field counts as
  // known even if it is not described.
  virtual bool Has(std::string_view name, bool written = true) = 0;
  // While reading: whether the value is a text. For fields that may have values of two types.
  virtual bool IsText(const FieldKey& key) = 0;
  // Makes an unknown field of this object an error in documents that ignore unknown fields.
  virtual void RefuseUnknown() = 0;

  // While reading, a failed status or condition is an error. Require() adds where(), and
  // RequireAt() where(key).
  virtual void Check(const Status& status) = 0;
  void Require(bool condition, std::string_view problem, std::string_view remedy = {});
  void RequireAt(const FieldKey& key,
                 bool condition,
                 std::string_view problem,
                 std::string_view remedy = {});

  virtual void Number(const FieldKey& key,
                      double& value,
                      double min = std::numeric_limits<double>::lowest(),
                      double max = std::numeric_limits<double>::max()) = 0;
  void Number(const FieldKey& key,
              float& value,
              double min = std::numeric_limits<double>::lowest(),
              double max = std::numeric_limits<double>::max());
  virtual void Integer(const FieldKey& key, int64_t& value, int64_t min, int64_t max) = 0;
  virtual void Flag(const FieldKey& key, bool& value) = 0;
  virtual void Text(const FieldKey& key, std::string& value, size_t max_bytes = 1 << 20) = 0;
  // A value that is kept as it is.
  virtual void Raw(const FieldKey& key, nlohmann::json& value) = 0;
  // A list of exactly as many numbers as there are values.
  virtual void Numbers(const FieldKey& key, std::span<double> values) = 0;
  void Numbers(const FieldKey& key, std::span<float> values);

  template <std::integral Int>
  void Integer(const FieldKey& key, Int& value, int64_t min, int64_t max) {
    auto wide = static_cast<int64_t>(value);
    Integer(key, wide, min, max);
    if (reading()) {
      value = static_cast<Int>(wide);
    }
  }
  // A number that may be missing.
  template <std::floating_point Float>
  void Number(const FieldKey& key,
              std::optional<Float>& value,
              double min = std::numeric_limits<double>::lowest(),
              double max = std::numeric_limits<double>::max()) {
    Present(key, value, [&](const FieldKey& present) { Number(present, *value, min, max); });
  }
  // A text that is one of the names; the value is its index. In the problem, "{}" stands for a text
  // that is no name; in the remedy, for the names from the first to the last.
  template <typename Enum>
  void Choice(const FieldKey& key,
              Enum& value,
              std::span<const std::string_view> names,
              std::string_view problem,
              std::string_view remedy = {}) {
    const size_t index = ChoiceIndex(key, static_cast<size_t>(value), names, problem, remedy);
    if (reading()) {
      value = static_cast<Enum>(index);
    }
  }
  // The field "schema". While reading: if it is not `current`, `problem` (with the number for "{}")
  // is the error. Without a problem, or without the remedy for an earlier schema, the numbers
  // above or below `current` are out of its range.
  void Schema(int64_t current,
              std::string_view problem = {},
              std::string_view remedy = {},
              std::string_view earlier_remedy = {});

  // An object of its own. describe(fields, value) describes it; without `describe`,
  // DescribeFields() does.
  template <typename T, typename Describe>
  void Object(const FieldKey& key, T& value, Describe describe) {
    if (EnterObject(key)) {
      describe(*this, value);
      Leave();
    }
  }
  template <typename T>
  void Object(const FieldKey& key, T& value) {
    Object(key, value, [](Fields& fields, T& object) { DescribeFields(fields, object); });
  }
  // An object that may be missing.
  template <typename T, typename Describe>
  void Object(const FieldKey& key, std::optional<T>& value, Describe describe) {
    Present(key, value, [&](const FieldKey& present) { Object(present, *value, describe); });
  }
  template <typename T>
  void Object(const FieldKey& key, std::optional<T>& value) {
    Present(key, value, [&](const FieldKey& present) { Object(present, *value); });
  }

  // A list of at most max_count entries. Entries are objects that describe(fields, entry) or
  // DescribeFields() describes, unless `describe` takes (key, entry) and adds the entry itself.
  template <typename T, typename Describe>
  void List(const FieldKey& key, std::vector<T>& values, size_t max_count, Describe describe) {
    if (const std::optional<size_t> count = EnterList(key, values.size(), max_count)) {
      if (reading()) {
        values.resize(*count);
      }
      for (size_t i = 0; i < values.size(); ++i) {
        Entry(FieldKey(i), values[i], describe);
      }
      Leave();
    }
  }
  template <typename T>
  void List(const FieldKey& key, std::vector<T>& values, size_t max_count) {
    List(key, values, max_count, [](Fields& fields, T& entry) { DescribeFields(fields, entry); });
  }
  // An object whose fields have names of the author's choice. `problem` is the error if it is no
  // object or has more than max_count fields. `describe` is as for List().
  template <typename Map, typename Describe>
  void Entries(const FieldKey& key,
               Map& values,
               size_t max_count,
               std::string_view problem,
               Describe describe) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) {
      names.push_back(name);
    }
    if (EnterEntries(key, names, max_count, problem)) {
      for (const std::string& name : names) {
        Entry(FieldKey(std::string_view(name)), values[name], describe);
      }
      Leave();
    }
  }

 protected:
  // Each returns whether there is something to describe, which ends with Leave().
  virtual bool EnterObject(const FieldKey& key) = 0;
  // count: the number of entries to write. Returns the number of entries that are described.
  virtual std::optional<size_t> EnterList(const FieldKey& key, size_t count, size_t max_count) = 0;
  // names: while writing, the fields of the object; while reading, they are set.
  virtual bool EnterEntries(const FieldKey& key,
                            std::vector<std::string>& names,
                            size_t max_count,
                            std::string_view problem) = 0;
  virtual void Leave() = 0;

 private:
  size_t ChoiceIndex(const FieldKey& key,
                     size_t index,
                     std::span<const std::string_view> names,
                     std::string_view problem,
                     std::string_view remedy);

  template <typename T, typename Describe>
  void Entry(const FieldKey& key, T& value, Describe& describe) {
    if constexpr (std::invocable<Describe&, Fields&, T&>) {
      Object(key, value, std::ref(describe));
    } else {
      describe(key, value);
    }
  }

  template <typename T, typename Describe>
  void Present(const FieldKey& key, std::optional<T>& value, Describe describe) {
    if (Has(key.name, value.has_value())) {
      if (!value) {
        value.emplace();
      }
      describe(FieldKey(key.name));
    }
  }
};

enum class UnknownFields { kRefuse, kIgnore };

// Each applies a description to a whole document, which is an object. A text is parsed first, and
// called `where` in errors.
Status ReadFields(const JsonView& view,
                  const std::function<void(Fields&)>& describe,
                  UnknownFields unknown = UnknownFields::kRefuse);
Status ReadFields(std::string_view text,
                  std::string_view where,
                  const std::function<void(Fields&)>& describe,
                  UnknownFields unknown = UnknownFields::kRefuse);
nlohmann::json WriteFields(const std::function<void(Fields&)>& describe);

// The same for a value of one type, which DescribeFields() or another function describes.
template <typename T>
using Description = void (*)(Fields&, T&);

template <typename T>
Result<T> ParseFields(const JsonView& view,
                      Description<T> describe,
                      UnknownFields unknown = UnknownFields::kRefuse) {
  T value;
  LARARIUM_RETURN_IF_ERROR(ReadFields(
      view, [&](Fields& fields) { describe(fields, value); }, unknown));
  return value;
}
template <typename T>
Result<T> ParseFields(const JsonView& view, UnknownFields unknown = UnknownFields::kRefuse) {
  return ParseFields<T>(
      view, [](Fields& fields, T& value) { DescribeFields(fields, value); }, unknown);
}
template <typename T>
Result<T> ParseFields(std::string_view text,
                      std::string_view where,
                      Description<T> describe,
                      UnknownFields unknown = UnknownFields::kRefuse) {
  T value;
  LARARIUM_RETURN_IF_ERROR(ReadFields(
      text, where, [&](Fields& fields) { describe(fields, value); }, unknown));
  return value;
}

// Returns Json; the deduced type keeps the whole of the JSON library out of this header.
template <typename T>
auto FormatFields(const T& value, std::type_identity_t<Description<T>> describe) {
  // Writing does not change the value.
  return WriteFields([&](Fields& fields) { describe(fields, const_cast<T&>(value)); });
}
template <typename T>
auto FormatFields(const T& value) {
  return FormatFields(value, [](Fields& fields, T& object) { DescribeFields(fields, object); });
}

}  // namespace lararium
