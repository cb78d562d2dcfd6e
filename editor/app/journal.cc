#include "editor/app/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>
#include <vector>

#include "shared/core/file.h"

namespace lararium::app {
namespace {

constexpr std::string_view kMagic = "lararium journal 1\n";
constexpr uint64_t kMaxBytes = uint64_t{1} << 30;

// FNV-1a, 64 bits (Fowler, Noll, Vo): enough to know a record that was cut off.
uint64_t CheckSum(std::string_view bytes) {
  uint64_t sum = 14695981039346656037u;
  for (const char c : bytes) {
    sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211u;
  }
  return sum;
}

// "kind number... bytes sum\n" and the payload, ended by a newline.
std::string Record(std::string_view header, std::string_view payload) {
  std::string record(header);
  record += ' ' + std::to_string(payload.size()) + ' ' + std::to_string(CheckSum(payload)) + '\n';
  record += payload;
  record += '\n';
  return record;
}

std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Beginning(const Json& project, const std::string& script) {
  return std::string(kMagic) + Record("project", Dump(project)) + Record("script", script);
}

// Goes through the records of a journal.
class Records {
 public:
  explicit Records(std::string_view text) : text_(text) {}

  struct Entry {
    std::string_view kind;
    std::vector<uint64_t> numbers;  // between the kind and the payload's length
    std::string_view payload;
  };

  // nullopt at the end, or where the rest was cut off: torn().
  std::optional<Entry> Next() {
    if (text_.empty()) {
      return std::nullopt;
    }
    torn_ = true;
    const size_t line_end = text_.find('\n');
    if (line_end == std::string_view::npos) {
      return std::nullopt;
    }
    std::string_view line = text_.substr(0, line_end);
    Entry entry;
    entry.kind = line.substr(0, line.find(' '));
    line.remove_prefix(entry.kind.size());
    while (!line.empty()) {
      line.remove_prefix(1);
      uint64_t number = 0;
      const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
      if (error != std::errc() || (end != line.data() + line.size() && *end != ' ')) {
        return std::nullopt;
      }
      entry.numbers.push_back(number);
      line.remove_prefix(static_cast<size_t>(end - line.data()));
    }
    if (entry.numbers.size() < 2) {
      return std::nullopt;
    }
    const uint64_t sum = entry.numbers.back();
    entry.numbers.pop_back();
    const uint64_t bytes = entry.numbers.back();
    entry.numbers.pop_back();
    const size_t begin = line_end + 1;
    if (bytes >= text_.size() - begin || text_[begin + bytes] != '\n') {
      return std::nullopt;
    }
    entry.payload = text_.substr(begin, bytes);
    if (CheckSum(entry.payload) != sum) {
      return std::nullopt;
    }
    text_.remove_prefix(begin + bytes + 1);
    torn_ = false;
    return entry;
  }

  bool torn() const { return torn_; }

 private:
  std::string_view text_;
  bool torn_ = false;
};

// nlohmann-json throws where a patch does not fit.
bool Patch(Json& json, std::string_view text) {
  try {
    json = json.patch(Json::parse(text));
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

bool Patch(std::string& script, const Records::Entry& entry) {
  if (entry.numbers.size() != 2) {
    return false;
  }
  const uint64_t offset = entry.numbers[0];
  const uint64_t removed = entry.numbers[1];
  if (removed > entry.payload.size() || offset > script.size() ||
      script.compare(offset, removed, entry.payload.substr(0, removed)) != 0) {
    return false;
  }
  script.replace(offset, removed, entry.payload.substr(removed));
  return true;
}

}  // namespace

Journal::Journal(std::filesystem::path file,
                 const ProjectDocument& project,
                 std::shared_ptr<const std::string> script)
    : file_(std::move(file)),
      project_(FormatProject(project)),
      script_(std::move(script)),
      syncer_([this](std::stop_token stop) {
        while (const std::optional<int> descriptor = written_.Take(stop)) {
          ::fdatasync(*descriptor);  // one that was closed since is no harm
        }
      }) {}

Journal::~Journal() { Close(); }

void Journal::Close() {
  if (descriptor_ >= 0) {
    ::fdatasync(descriptor_);
    ::close(descriptor_);
    descriptor_ = -1;
  }
}

Status Journal::Restart(const ProjectDocument& project, std::shared_ptr<const std::string> script) {
  Close();
  failed_ = true;
  grown_ = 0;
  project_ = FormatProject(project);
  script_ = std::move(script);
  // An edit that changes nothing says that what the file begins with was never saved.
  LARARIUM_RETURN_IF_ERROR(
      WriteFileAtomically(file_, Beginning(project_, *script_) + Record("project-patch", "[]")));
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) {
    return Status::Error(file_.string(), std::string("cannot be written: ") + std::strerror(errno));
  }
  failed_ = false;
  return Status();
}

void Journal::Discard(const ProjectDocument& project, std::shared_ptr<const std::string> script) {
  Close();
  failed_ = false;
  grown_ = 0;
  project_ = FormatProject(project);
  script_ = std::move(script);
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

Status Journal::Append(std::string_view header, std::string_view payload) {
  if (failed_) {
    return Status();  // said already
  }
  if (descriptor_ < 0) {
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(file_, Beginning(project_, *script_)));
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  }
  const std::string record = Record(header, payload);
  size_t written = 0;
  while (descriptor_ >= 0 && written < record.size()) {
    const ssize_t count = ::write(descriptor_, record.data() + written, record.size() - written);
    if (count < 0 && errno != EINTR) {
      break;
    }
    written += count > 0 ? static_cast<size_t>(count) : 0;
  }
  if (written < record.size()) {
    failed_ = true;
    return Status::Error(file_.string(),
                         std::string("edits cannot be kept: ") + std::strerror(errno),
                         "make room on the disk and save");
  }
  grown_ += record.size();
  written_.Put(descriptor_);
  return Status();
}

Status Journal::NoteProject(const ProjectDocument& now) {
  Json next = FormatProject(now);
  const Json patch = Json::diff(project_, next);
  if (patch.empty()) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(Append("project-patch", Dump(patch)));
  project_ = std::move(next);
  return Status();
}

Status Journal::NoteScript(const drama::TextEdit& edit) {
  return Append(
      "script-edit " + std::to_string(edit.offset) + ' ' + std::to_string(edit.removed.size()),
      edit.removed + edit.inserted);
}

Result<std::optional<JournalContent>> LoadJournal(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return std::optional<JournalContent>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxBytes));
  const auto damaged = [&](std::string_view problem) {
    return Status::Error(file.string(), problem);
  };
  if (!text.starts_with(kMagic)) {
    return damaged("is no journal of this version");
  }
  Records records(std::string_view(text).substr(kMagic.size()));
  const auto project = records.Next();
  const auto script = records.Next();
  if (!project || project->kind != "project" || !script || script->kind != "script") {
    return damaged("is damaged at its beginning");
  }
  LARARIUM_ASSIGN_OR_RETURN(Json json, ParseJson(project->payload, file.string()));
  JournalContent content;
  content.script = script->payload;
  while (const auto entry = records.Next()) {
    const bool fits = entry->kind == "project-patch" ? Patch(json, entry->payload)
                      : entry->kind == "script-edit" ? Patch(content.script, *entry)
                                                     : false;
    if (!fits) {
      return damaged("holds an edit that does not fit those before it");
    }
    ++content.edits;
  }
  content.torn = records.torn();
  LARARIUM_ASSIGN_OR_RETURN(content.project, ParseProject(json, file.string()));
  return std::optional<JournalContent>(std::move(content));
}

}  // namespace lararium::app
