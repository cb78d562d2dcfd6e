#include "editor/session/product_notes.h"

#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/jobs/baking.h"

namespace lararium::editor {

const std::vector<std::string>& ProductNotes::Of(const std::filesystem::path& product) {
  std::string key = product.string() + " " + FileStamp(product);
  if (key != key_) {
    key_ = std::move(key);
    warnings_ = ProductWarnings(product);
  }
  return warnings_;
}

}  // namespace lararium::editor
