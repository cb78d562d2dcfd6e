#include "editor/bake/line_folder.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <system_error>
#include <utility>

#include "editor/text/foreign_text.h"
#include "shared/core/lower_case.h"

namespace lararium::bake {
namespace {

// What recorders, phones and editors write; ReadSound() reads all of them.
constexpr std::string_view kSounds[] = {".wav", ".wave", ".bwf", ".rf64", ".w64",  ".flac", ".ogg",
                                        ".oga", ".opus", ".mp3", ".mp2",  ".m4a",  ".m4b",  ".aac",
                                        ".mp4", ".mov",  ".3gp", ".aif",  ".aiff", ".aifc", ".caf",
                                        ".au",  ".wma",  ".amr", ".mka",  ".webm", ".ac3"};
constexpr std::string_view kCaptions[] = {".srt", ".vtt"};

// "Hail" and "hail" have the same key, as have "a_b" and "a-b".
std::string KeyOf(std::string_view stem) {
  std::string key = LowerCase(editor::TrimBlanks(stem));
  std::replace(key.begin(), key.end(), '_', '-');
  return key;
}

bool IsOneOf(std::string_view extension, std::span<const std::string_view> extensions) {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

// Letters and digits only.
std::string Squashed(std::string_view text) {
  std::string squashed = LowerCase(text);
  std::erase_if(squashed, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return squashed;
}

// Number of letters to insert, remove or replace (Levenshtein).
size_t Distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

// How well the name of a file fits a line's id; 0: not at all.
size_t Resemblance(std::string_view stem, std::string_view id) {
  constexpr size_t kShortest = 3;  // Shorter ids occur in other words by chance.
  const std::string name = Squashed(stem.substr(0, 200));
  const std::string wanted = Squashed(id);
  if (name == wanted) {
    return 1000;
  }
  if (wanted.size() < kShortest) {
    return 0;
  }
  if (name.find(wanted) != std::string::npos) {
    return 100 + wanted.size();
  }
  return Distance(name, wanted) <= wanted.size() / 4 ? 1 : 0;
}

}  // namespace

LineFolder::LineFolder(const std::filesystem::path& folder, std::span<const Line> lines) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  for (; !error && entries != std::filesystem::directory_iterator(); entries.increment(error)) {
    const std::filesystem::path& path = entries->path();
    std::error_code ignored;
    if (!path.filename().string().starts_with('.') && entries->is_regular_file(ignored)) {
      const std::string stem = path.stem().string();
      files_.insert({KeyOf(stem), {path, stem, LowerCase(path.extension().string())}});
    }
  }
  for (const Line& line : lines) {
    ids_.insert(line.id);
  }
}

std::vector<const LineFolder::File*> LineFolder::Find(const std::string& stem,
                                                      Extensions extensions) const {
  std::vector<const File*> exact;
  std::vector<const File*> alike;
  const auto [begin, end] = files_.equal_range(KeyOf(stem));
  for (auto at = begin; at != end; ++at) {
    const File& file = at->second;
    if (!IsOneOf(file.extension, extensions)) {
      continue;
    }
    if (file.stem == stem) {
      exact.push_back(&file);
    } else if (!ids_.contains(file.stem)) {
      alike.push_back(&file);
    }
  }
  std::vector<const File*>& found = exact.empty() ? alike : exact;
  std::sort(found.begin(), found.end(),
            [](const File* a, const File* b) { return a->path < b->path; });
  return std::move(found);
}

Result<std::filesystem::path> LineFolder::OnlyOne(const std::string& stem,
                                                  Extensions extensions) const {
  const std::vector<const File*> found = Find(stem, extensions);
  if (found.size() > 1) {
    return Status::Error(found[1]->path.string(),
                         "there is " + found[0]->path.filename().string() + " too",
                         "keep one of them");
  }
  return found.empty() ? std::filesystem::path() : found[0]->path;
}

Result<std::filesystem::path> LineFolder::Recording(const std::string& line) const {
  return OnlyOne(line, kSounds);
}

Result<std::filesystem::path> LineFolder::Captions(const std::string& line,
                                                   const std::string& language) const {
  return OnlyOne(line + "." + language, kCaptions);
}

std::vector<StrayFile> LineFolder::Strays() const {
  std::set<std::string> keys;
  std::vector<std::string> without;
  for (const std::string& id : ids_) {
    keys.insert(KeyOf(id));
    if (Find(id, kSounds).empty()) {
      without.push_back(id);
    }
  }
  std::vector<StrayFile> strays;
  for (const auto& [key, file] : files_) {
    const bool sound = IsOneOf(file.extension, kSounds);
    const bool captions = IsOneOf(file.extension, kCaptions);
    const std::string stem = captions ? file.stem.substr(0, file.stem.rfind('.')) : file.stem;
    if ((!sound && !captions) || keys.contains(KeyOf(stem))) {
      continue;
    }
    StrayFile& stray = strays.emplace_back(StrayFile{file.path, ""});
    size_t best = 0;
    for (const std::string& id : without) {
      const size_t resemblance = sound ? Resemblance(stem, id) : 0;
      stray.line = resemblance > best ? id : stray.line;
      best = std::max(best, resemblance);
    }
  }
  return strays;
}

}  // namespace lararium::bake
