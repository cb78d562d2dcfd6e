#pragma once

// What is tried until there is a context. Private to render.

#include <utility>

#include "shared/core/status.h"
#include "shared/render/graphics_context.h"

namespace lararium::render {

// Whether the current context has all that pictures are drawn with.
Status CheckDriver();

// create(api): a Result of something that has made its context current. An error names all
// that was tried.
template <typename Create>
auto CreateChosen(GraphicsChoice choice, const Create& create) {
  const auto checked = [&create](GraphicsApi api) {
    auto made = create(api);
    if (made.ok()) {
      if (Status status = CheckDriver(); !status.ok()) {
        made = std::move(status);
      }
    }
    return made;
  };
  auto first = checked(choice.value_or(GraphicsApi::kOpenGl33));
  if (first.ok() || choice) {
    return first;
  }
  auto second = checked(GraphicsApi::kOpenGlEs30);
  if (!second.ok()) {
    second = Status::Error("", first.message() + "\n" + second.message());
  }
  return second;
}

}  // namespace lararium::render
