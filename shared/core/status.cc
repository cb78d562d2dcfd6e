#include "shared/core/status.h"

namespace lararium {

Status Status::Error(std::string_view place, std::string_view problem, std::string_view remedy) {
  Status status;
  if (!place.empty()) {
    status.message_.append(place).append(": ");
  }
  status.message_.append(problem.empty() ? "unknown error" : problem);
  if (!remedy.empty()) {
    status.message_.append("; ").append(remedy);
  }
  return status;
}

Status Status::At(std::string_view place) const { return ok() ? *this : Error(place, message_); }

}  // namespace lararium
