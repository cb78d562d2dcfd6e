// libFuzzer harness: any bytes as the journal left by a crash are read completely, or up to where
// they were cut off, or refused.

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "editor/document/journal.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium;
  const int file = ::memfd_create("journal", MFD_CLOEXEC);
  CHECK(file >= 0);
  CHECK(::write(file, data, size) == static_cast<ssize_t>(size));
  const auto content = editor::LoadJournal("/proc/self/fd/" + std::to_string(file), nullptr);
  if (content.ok() && content->has_value()) {
    CHECK((*content)->edits >= 0);
    CHECK(editor::FormatProject((*content)->project).is_object());
  }
  ::close(file);
  return 0;
}
