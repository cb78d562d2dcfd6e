// Any text as the use of an object, and then what the stage asks of one that is right.

#include <string_view>

#include "shared/stage/object.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::stage;
  Prop prop;
  prop.parts.resize(2);
  prop.parts[0].name = "body";
  prop.parts[1].name = "lid";
  prop.parts[1].parent = 0;
  prop.use = std::string_view(reinterpret_cast<const char*>(data), size);
  const auto model = ObjectModel::Create(std::move(prop), "fuzz.object.json");
  if (model.ok()) {
    Object object;
    object.model = *model;
    const ObjectState state = InitialState(object);
    for (size_t grip = 0; grip < object.use().grips.size(); ++grip) {
      ObjectFromGrip(**model, state.joints, static_cast<int>(grip));
    }
  }
  return 0;
}
