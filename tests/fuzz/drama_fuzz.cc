// libFuzzer harness: runs any text as a script; the host must survive.

#include <string_view>

#include "shared/drama/drama.h"
#include "tests/stage/test_human.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  static const std::shared_ptr<Log> log = MakeSilentLog();
  static const std::shared_ptr<const human::Human> human = test::MakeTestHuman();
  stage::Stage stage;
  CHECK(stage.Add("keeper", human).ok());
  drama::DramaOptions options;
  options.memory_limit = 4 << 20;
  options.instruction_limit = 100'000;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto drama = drama::Drama::Create(text, "fuzz.lua", stage, options, *log);
  for (int tick = 0; drama.ok() && tick < 3; ++tick) {
    (*drama)->Tick();
  }
  return 0;
}
