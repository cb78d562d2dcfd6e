#include "shared/core/json_fields.h"

#include <algorithm>

#include "shared/core/json.h"

namespace lararium {
namespace {

std::string Filled(std::string_view text, std::string_view name) {
  std::string filled(text);
  if (const size_t at = filled.find("{}"); at != std::string::npos) {
    filled.replace(at, 2, name);
  }
  return filled;
}

class FieldReader final : public Fields {
 public:
  FieldReader(const JsonView& root, UnknownFields unknown) {
    Push(root, unknown == UnknownFields::kRefuse);
  }

  // Ends the description of the root.
  Status Finish() {
    Leave();
    return std::move(status_);
  }

  bool reading() const override { return true; }
  std::string where() const override { return levels_.back().view.place(); }
  std::string where(const FieldKey& key) override {
    const std::optional<JsonView> field = Find(key);
    return field ? field->place() : where();
  }
  bool Has(std::string_view name, bool /*written*/) override {
    Note(name);
    return status_.ok() && levels_.back().view.Has(name);
  }
  bool IsText(const FieldKey& key) override {
    FieldKey present = key;
    present.required = false;
    const std::optional<JsonView> field = Find(present);
    return field && field->json().is_string();
  }
  void RefuseUnknown() override { levels_.back().refuse_unknown = true; }
  void Check(const Status& status) override {
    if (status_.ok()) {
      status_ = status;
    }
  }

  void Number(const FieldKey& key, double& value, double min, double max) override {
    if (const std::optional<JsonView> field = Find(key)) {
      Take(field->Number(min, max), value);
    }
  }
  void Integer(const FieldKey& key, int64_t& value, int64_t min, int64_t max) override {
    if (const std::optional<JsonView> field = Find(key)) {
      Take(field->Integer(min, max), value);
    }
  }
  void Flag(const FieldKey& key, bool& value) override {
    if (const std::optional<JsonView> field = Find(key)) {
      Take(field->Boolean(), value);
    }
  }
  void Text(const FieldKey& key, std::string& value, size_t max_bytes) override {
    if (const std::optional<JsonView> field = Find(key)) {
      Take(field->Text(max_bytes), value);
    }
  }
  void Raw(const FieldKey& key, Json& value) override {
    if (const std::optional<JsonView> field = Find(key)) {
      value = field->json();
    }
  }
  void Numbers(const FieldKey& key, std::span<double> values) override {
    std::vector<double> numbers(values.begin(), values.end());
    if (const std::optional<JsonView> field = Find(key)) {
      Take(field->Numbers(values.size()), numbers);
    }
    std::copy(numbers.begin(), numbers.end(), values.begin());
  }

 protected:
  bool EnterObject(const FieldKey& key) override {
    const std::optional<JsonView> field = Find(key);
    if (field) {
      Push(*field, levels_.back().refuse_unknown);
    }
    return field.has_value();
  }

  std::optional<size_t> EnterList(const FieldKey& key,
                                  size_t /*count*/,
                                  size_t max_count) override {
    const std::optional<JsonView> field = Find(key);
    std::vector<JsonView> entries;
    if (!field || !Take(field->Array(max_count), entries)) {
      return std::nullopt;
    }
    const size_t count = entries.size();
    levels_.push_back({*field, std::move(entries), {}, levels_.back().refuse_unknown});
    return count;
  }

  bool EnterEntries(const FieldKey& key,
                    std::vector<std::string>& names,
                    size_t max_count,
                    std::string_view problem) override {
    const std::optional<JsonView> field = Find(key);
    if (!field) {
      return false;
    }
    if (!field->json().is_object() || field->json().size() > max_count) {
      status_ = field->Problem(problem);
      return false;
    }
    names.clear();
    for (const auto& [name, value] : field->json().items()) {
      names.push_back(name);
    }
    levels_.push_back({*field, {}, {}, levels_.back().refuse_unknown, true});
    return true;
  }

  // A misspelled field is reported as unknown rather than as missing.
  void Leave() override {
    const Level& level = levels_.back();
    if (level.refuse_unknown && !level.free_names && level.view.json().is_object() &&
        (status_.ok() || missing_level_ == levels_.size())) {
      if (const Status known = level.view.CheckFields(level.known); !known.ok()) {
        status_ = known;
      }
    }
    levels_.pop_back();
  }

 private:
  struct Level {
    JsonView view;
    std::vector<JsonView> entries;        // Entries of a list; empty for an object.
    std::vector<std::string_view> known;  // The fields of an object that were described.
    bool refuse_unknown = false;
    bool free_names = false;  // The author chooses the names of the fields.
  };

  void Push(const JsonView& object, bool refuse_unknown) {
    if (!object.json().is_object()) {
      Check(object.Problem("must be an object"));
    }
    levels_.push_back({object, {}, {}, refuse_unknown});
  }

  void Note(std::string_view name) {
    std::vector<std::string_view>& known = levels_.back().known;
    if (!levels_.back().free_names && std::find(known.begin(), known.end(), name) == known.end()) {
      known.push_back(name);
    }
  }

  std::optional<JsonView> Find(const FieldKey& key) {
    const Level& level = levels_.back();
    if (key.name.empty() && key.index < level.entries.size()) {
      return status_.ok() ? std::optional(level.entries[key.index]) : std::nullopt;
    }
    Note(key.name);
    if (!status_.ok() || (!key.required && !level.view.Has(key.name))) {
      return std::nullopt;
    }
    const Result<JsonView> field = level.view.Field(key.name);
    if (!field.ok()) {
      status_ = field.status();
      missing_level_ = levels_.size();
      return std::nullopt;
    }
    return *field;
  }

  template <typename T>
  bool Take(Result<T> result, T& value) {
    if (!result.ok()) {
      status_ = result.status();
      return false;
    }
    value = *std::move(result);
    return true;
  }

  std::vector<Level> levels_;  // Path from the root to the described object or list.
  Status status_;
  size_t missing_level_ = 0;  // The size of levels_ when a field was found to be missing.
};

class FieldWriter final : public Fields {
 public:
  Json Finish() { return std::move(root_); }

  bool reading() const override { return false; }
  std::string where() const override { return ""; }
  std::string where(const FieldKey& /*key*/) override { return ""; }
  bool Has(std::string_view /*name*/, bool written) override { return written; }
  bool IsText(const FieldKey& /*key*/) override { return false; }
  void RefuseUnknown() override {}
  void Check(const Status& /*status*/) override {}

  void Number(const FieldKey& key, double& value, double /*min*/, double /*max*/) override {
    Put(key, value);
  }
  void Integer(const FieldKey& key, int64_t& value, int64_t /*min*/, int64_t /*max*/) override {
    Put(key, value);
  }
  void Flag(const FieldKey& key, bool& value) override { Put(key, value); }
  void Text(const FieldKey& key, std::string& value, size_t /*max_bytes*/) override {
    Put(key, value);
  }
  void Raw(const FieldKey& key, Json& value) override { Put(key, value); }
  void Numbers(const FieldKey& key, std::span<double> values) override {
    Put(key, std::vector<double>(values.begin(), values.end()));
  }

 protected:
  bool EnterObject(const FieldKey& key) override { return Push(key, Json::object()); }
  std::optional<size_t> EnterList(const FieldKey& key,
                                  size_t count,
                                  size_t /*max_count*/) override {
    return Push(key, Json::array()) ? std::optional(count) : std::nullopt;
  }
  bool EnterEntries(const FieldKey& key,
                    std::vector<std::string>& /*names*/,
                    size_t /*max_count*/,
                    std::string_view /*problem*/) override {
    return Push(key, Json::object());
  }
  void Leave() override { levels_.pop_back(); }

 private:
  // Returns the value where it was put; nullptr where the field is left out.
  Json* Put(const FieldKey& key, Json value) {
    if (!key.written) {
      return nullptr;
    }
    Json& parent = *levels_.back();
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    Json& field = parent[std::string(key.name)];
    field = std::move(value);
    return &field;
  }

  bool Push(const FieldKey& key, Json value) {
    Json* const put = Put(key, std::move(value));
    if (put != nullptr) {
      levels_.push_back(put);
    }
    return put != nullptr;
  }

  Json root_ = Json::object();
  std::vector<Json*> levels_ = {&root_};  // Path from the root to the described object or list.
};

}  // namespace

void Fields::Require(bool condition, std::string_view problem, std::string_view remedy) {
  if (!condition && reading()) {
    Check(Status::Error(where(), problem, remedy));
  }
}

void Fields::RequireAt(const FieldKey& key,
                       bool condition,
                       std::string_view problem,
                       std::string_view remedy) {
  if (!condition && reading()) {
    Check(Status::Error(where(key), problem, remedy));
  }
}

void Fields::Number(const FieldKey& key, float& value, double min, double max) {
  double wide = value;
  Number(key, wide, min, max);
  if (reading()) {
    value = static_cast<float>(wide);
  }
}

void Fields::Numbers(const FieldKey& key, std::span<float> values) {
  std::vector<double> wide(values.begin(), values.end());
  Numbers(key, std::span(wide));
  if (reading()) {
    std::transform(wide.begin(), wide.end(), values.begin(),
                   [](double value) { return static_cast<float>(value); });
  }
}

size_t Fields::ChoiceIndex(const FieldKey& key,
                           size_t index,
                           std::span<const std::string_view> names,
                           std::string_view problem,
                           std::string_view remedy) {
  std::string name(names[index]);
  Text(key, name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    std::string known;
    for (const std::string_view one : names) {
      known += (known.empty() ? "" : ", ") + std::string(one);
    }
    Require(false, Filled(problem, name), Filled(remedy, known));
  }
  return found != names.end() ? static_cast<size_t>(found - names.begin()) : index;
}

void Fields::Schema(int64_t current,
                    std::string_view problem,
                    std::string_view remedy,
                    std::string_view earlier_remedy) {
  constexpr int64_t kHighest = 1'000'000;
  int64_t schema = current;
  Integer("schema", schema, earlier_remedy.empty() ? current : 1,
          problem.empty() ? current : kHighest);
  Require(schema == current, Filled(problem, std::to_string(schema)),
          schema < current ? earlier_remedy : remedy);
}

Status ReadFields(const JsonView& view,
                  const std::function<void(Fields&)>& describe,
                  UnknownFields unknown) {
  FieldReader reader(view, unknown);
  describe(reader);
  return reader.Finish();
}

Status ReadFields(std::string_view text,
                  std::string_view where,
                  const std::function<void(Fields&)>& describe,
                  UnknownFields unknown) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, where));
  return ReadFields(JsonView(json, std::string(where)), describe, unknown);
}

Json WriteFields(const std::function<void(Fields&)>& describe) {
  FieldWriter writer;
  describe(writer);
  return writer.Finish();
}

}  // namespace lararium
