#pragma once

// JSON with checked access: every error names the file and the field.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json_fwd.h"
#include "shared/core/status.h"

// Compiled once, in json.cc.
extern template class nlohmann::basic_json<>;

namespace lararium {

// where: the name of the text in error messages, normally its file.
Result<Json> ParseJson(std::string_view text, std::string_view where);
Result<Json> LoadJson(const std::filesystem::path& path);
// A name of a file may hold bytes that are no UTF-8, which JSON texts cannot hold. DumpJson()
// writes such a byte as one of the private characters U+EF80 to U+EFFF, and ParseJson() makes it a
// byte again, so that every string comes back as it was.
std::string DumpJson(const Json& json, int indent = -1);
Status SaveJson(const std::filesystem::path& path, const Json& json);

// A view of one JSON value that knows its path within the file. An error reads, for example,
// "project.json: stage.scale: must be a finite number".
class JsonView {
 public:
  // path: the field of the file that holds the value, such as "stage.scale"; empty: the file
  // itself.
  JsonView(const Json& json, std::string file, std::string path = {})
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

  const Json& json() const { return *json_; }
  std::string place() const { return path_.empty() ? file_ : file_ + ": " + path_; }
  Status Problem(std::string_view problem, std::string_view remedy = {}) const {
    return Status::Error(place(), problem, remedy);
  }

  // Returns an error if this is no object or has a field that is not listed.
  Status CheckFields(std::span<const std::string_view> known) const;
  Status CheckFields(std::initializer_list<std::string_view> known) const {
    return CheckFields(std::span(known.begin(), known.size()));
  }

  bool Has(std::string_view key) const;
  Result<JsonView> Field(std::string_view key) const;
  // Returns all elements of an array of at most max_count elements.
  Result<std::vector<JsonView>> Array(size_t max_count = 1'000'000) const;

  // Returns the value, checked for type and range.
  Result<double> Number(double min = std::numeric_limits<double>::lowest(),
                        double max = std::numeric_limits<double>::max()) const;
  Result<int64_t> Integer(int64_t min, int64_t max) const;
  Result<bool> Boolean() const;
  Result<std::string> Text(size_t max_bytes = 1 << 20) const;
  Result<std::vector<double>> Numbers(size_t count) const;

  // Same as above for a field of an object.
  Result<double> Number(std::string_view key,
                        double min = std::numeric_limits<double>::lowest(),
                        double max = std::numeric_limits<double>::max()) const;
  Result<int64_t> Integer(std::string_view key, int64_t min, int64_t max) const;
  Result<std::string> Text(std::string_view key, size_t max_bytes = 1 << 20) const;
  Result<std::vector<double>> Numbers(std::string_view key, size_t count) const;

 private:
  const Json* json_;
  std::string file_;
  std::string path_;
};

}  // namespace lararium
