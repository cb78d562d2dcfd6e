#pragma once

// Nobody is loaded in more detail than is seen of them: who comes nearer is read again, in more
// detail, beside the show, one after the other. Nobody becomes coarser: that would take as long as
// it saves.

#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/render/quality.h"
#include "shared/show/body.h"
#include "shared/show/show_content.h"

namespace lararium::show {

// What to read of a cast for pictures of a width in pixels (LoadShowContent): enough for whoever is
// not very near.
float FinestDetail(const render::Quality& quality, int width);

class FinerCast {
 public:
  // Borrows log. read: ShowContent::finer; may be empty.
  FinerCast(ReadPerson read, std::span<const CastMember> cast, Log& log);

  // So much detail is to be drawn of somebody: metres, as errors count (human::ErrorShare). What
  // comes is finer, so that a step further does not read again. Who cannot be read stays as they
  // are, and the log says why.
  void Want(size_t cast, float detail);

  struct Person {
    size_t cast = 0;
    Figure figure;
    std::shared_ptr<const UnpackedLight> light;
  };
  // Somebody who has been read since.
  std::optional<Person> Take();

  // kDone: Take() has what came of it.
  enum class Reading { kNobody, kSomebody, kDone };
  Reading reading() const;

 private:
  ReadPerson read_;
  std::vector<float> finest_;  // of each of the cast: metres; 0: all there is, or can be had
  Log& log_;
  size_t reading_cast_ = 0;
  float reading_finest_ = 0.0f;
  std::future<Result<Person>> reading_;
};

}  // namespace lararium::show
