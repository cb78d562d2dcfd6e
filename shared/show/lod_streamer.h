#pragma once

// Loads people only at the detail that is visible. A person who comes nearer is read again at a
// finer level in the background, one person at a time. A finer level is never replaced by a coarser
// one: that would cost as much as it saves.

#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/render/quality.h"
#include "shared/show/character_instance.h"
#include "shared/show/show_content.h"

namespace lararium::show {

// Detail in metres at which LoadShowContent() should read a cast for pictures of a width in pixels:
// sufficient for people who are not very near.
float FinestDetail(const render::Quality& quality, int width);

class LodStreamer {
 public:
  // Borrows log. read: ShowContent::finer; may be empty.
  LodStreamer(ReadPerson read, std::span<const CastMember> cast, Log& log);

  // Requests a detail for a member of the cast: metres, as in human::ErrorShare. The detail read is
  // finer than requested, so that one more step does not read again. If reading fails, the person
  // stays as is, and the log has the error.
  void Want(size_t cast, float detail);

  struct Person {
    size_t cast = 0;
    CharacterMesh figure;
    std::shared_ptr<const UnpackedLight> light;
  };
  // Returns a person whose reading has finished, if any.
  std::optional<Person> Take();

  // kDone: Take() returns the result.
  enum class Reading { kNobody, kSomebody, kDone };
  Reading reading() const;

 private:
  ReadPerson read_;
  // Detail of each cast member, metres; 0: no finer detail exists or can be read.
  std::vector<float> finest_;
  Log& log_;
  size_t reading_cast_ = 0;
  float reading_finest_ = 0.0f;
  std::future<Result<Person>> reading_;
};

}  // namespace lararium::show
