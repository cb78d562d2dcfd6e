#include "shared/core/status.h"

namespace lararium {

Status Status::Error(std::string_view where, std::string_view problem, std::string_view remedy) {
  Status status;
  if (!where.empty()) {
    status.message_.append(where).append(": ");
  }
  status.message_.append(problem.empty() ? "unknown error" : problem);
  if (!remedy.empty()) {
    status.message_.append("; ").append(remedy);
  }
  return status;
}

Status Status::At(std::string_view where) const { return ok() ? *this : Error(where, message_); }

}  // namespace lararium
