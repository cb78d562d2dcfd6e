#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lararium::editor {

// The warnings of the product that was asked for last, read again when it is baked again.
class ProductNotes {
 public:
  const std::vector<std::string>& Of(const std::filesystem::path& product);

 private:
  std::string key_;  // The product with its stamp.
  std::vector<std::string> warnings_;
};

}  // namespace lararium::editor
