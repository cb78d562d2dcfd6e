#pragma once

// Errors as values. A function that can fail on its input (a file, an image, a script, a device)
// returns Status or Result<T>; nothing is thrown. The text of an error says where the problem is,
// what is wrong, and what to do.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "shared/core/check.h"

namespace lararium {

class [[nodiscard]] Status {
 public:
  // Success.
  Status() = default;

  // A failure that reads "place: problem; remedy". `where` is a file, a file with a line, or a
  // field. `remedy` may be empty if the user can do nothing.
  static Status Error(std::string_view where,
                      std::string_view problem,
                      std::string_view remedy = {});

  bool ok() const { return message_.empty(); }
  const std::string& message() const { return message_; }

  // Returns the same failure with an outer location: "place: message".
  Status At(std::string_view where) const;

 private:
  std::string message_;
};

// A value, or the Status that says why there is none.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}        // NOLINT: converts on purpose
  Result(Status status) : content_(std::move(status)) {  // NOLINT: converts on purpose
    CHECK(!std::get<Status>(content_).ok());
  }

  bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }

  Status status() const { return ok() ? Status() : std::get<Status>(content_); }
  const std::string& message() const { return std::get<Status>(content_).message(); }

  T& value() & {
    CHECK(ok());
    return std::get<T>(content_);
  }
  const T& value() const& {
    CHECK(ok());
    return std::get<T>(content_);
  }
  T&& value() && {
    CHECK(ok());
    return std::get<T>(std::move(content_));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  std::variant<T, Status> content_;
};

}  // namespace lararium

// Returns from the calling function when expression (a Status) failed.
#define LARARIUM_RETURN_IF_ERROR(expression)                                        \
  do {                                                                              \
    if (::lararium::Status lararium_failed = (expression); !lararium_failed.ok()) { \
      return lararium_failed;                                                       \
    }                                                                               \
  } while (false)

#define LARARIUM_CONCAT_INNER(a, b) a##b
#define LARARIUM_CONCAT(a, b) LARARIUM_CONCAT_INNER(a, b)

// LARARIUM_ASSIGN_OR_RETURN(auto image, LoadImage(path)): declares image, or
// returns the Status of a failed Result.
// NOLINTBEGIN(bugprone-macro-parentheses): a declaration takes none
#define LARARIUM_ASSIGN_OR_RETURN(declaration, expression) \
  auto LARARIUM_CONCAT(result_, __LINE__) = (expression);  \
  if (!LARARIUM_CONCAT(result_, __LINE__).ok()) {          \
    return LARARIUM_CONCAT(result_, __LINE__).status();    \
  }                                                        \
  declaration = std::move(LARARIUM_CONCAT(result_, __LINE__)).value()
// NOLINTEND(bugprone-macro-parentheses)
