#include "editor/document/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>
#include <vector>

#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::editor {
namespace {

constexpr std::string_view kMagic = "lararium journal 2\n";
constexpr uint64_t kMaxBytes = uint64_t{1} << 30;

// FNV-1a, 64 bits (Fowler, Noll, Vo): enough to detect a truncated record.
uint64_t CheckSum(std::string_view bytes) {
  uint64_t sum = 14695981039346656037u;
  for (const char c : bytes) {
    sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211u;
  }
  return sum;
}

// "kind number... bytes sum\n", the payload and a newline.
std::string Record(std::string_view header, std::string_view payload) {
  std::string record(header);
  record += ' ' + std::to_string(payload.size()) + ' ' + std::to_string(CheckSum(payload)) + '\n';
  record += payload;
  record += '\n';
  return record;
}

std::string Dump(const Json& json) { return DumpJson(json); }

std::string EditHeader(std::string_view kind, const drama::TextEdit& edit) {
  return std::string(kind) + ' ' + std::to_string(edit.offset) + ' ' +
         std::to_string(edit.removed.size());
}

// Iterates over the records of a journal.
class Records {
 public:
  explicit Records(std::string_view text) : text_(text) {}

  struct Entry {
    std::string_view kind;
    std::vector<uint64_t> numbers;  // The numbers between the kind and the payload's length.
    std::string_view payload;
  };

  // nullopt at the end, or where the rest is truncated; see torn().
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

// Returns false where the patch does not fit: nlohmann-json throws then.
bool Patch(Json& json, std::string_view text) {
  try {
    json = json.patch(Json::parse(text));
    return true;
  } catch (const Json::exception&) {
    return false;
  }
}

bool Patch(std::string& text, const Records::Entry& entry) {
  if (entry.numbers.size() != 2) {
    return false;
  }
  const uint64_t offset = entry.numbers[0];
  const uint64_t removed = entry.numbers[1];
  if (removed > entry.payload.size() || offset > text.size() ||
      text.compare(offset, removed, entry.payload.substr(0, removed)) != 0) {
    return false;
  }
  text.replace(offset, removed, entry.payload.substr(removed));
  return true;
}

// The state after applying the records of a journal.
struct Replay {
  Json project;
  std::string script;
  std::optional<std::string> lines;
  int edits = 0;

  // Returns false where the record does not fit the earlier ones.
  bool Take(const Records::Entry& entry) {
    // The first state of the table of lines, not an edit.
    if (entry.kind == "lines") {
      lines = entry.payload;
      return true;
    }
    ++edits;
    return entry.kind == "project-patch" ? Patch(project, entry.payload)
           : entry.kind == "script-edit" ? Patch(script, entry)
           : entry.kind == "lines-edit"  ? lines && Patch(*lines, entry)
                                         : false;
  }
};

}  // namespace

// An open file, which is closed when neither the journal nor its thread uses it.
class Journal::Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() { ::close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

std::shared_ptr<const Journal::Descriptor> Journal::Open() const {
  const int descriptor = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  return descriptor < 0 ? nullptr : std::make_shared<const Descriptor>(descriptor);
}

Journal::Journal(std::filesystem::path file,
                 const ProjectDocument& project,
                 std::shared_ptr<const std::string> script)
    : file_(std::move(file)), syncer_([this](std::stop_token stop) {
        while (const auto descriptor = written_.Take(stop)) {
          ::fdatasync((*descriptor)->get());
        }
      }) {
  Begin(project, std::move(script));
  writer_ = std::jthread([this](std::stop_token stop) {
    while (const auto step = steps_.Take(stop)) {
      WriteStep(*step);
    }
  });
}

Journal::~Journal() {
  writer_ = {};
  if (const auto step = steps_.TryTake()) {
    WriteStep(*step);
  }
  Close();
}

void Journal::Close() {
  if (descriptor_ != nullptr) {
    ::fdatasync(descriptor_->get());
    descriptor_ = nullptr;
  }
}

void Journal::Begin(const ProjectDocument& project, std::shared_ptr<const std::string> script) {
  grown_ = 0;
  project_ = FormatProject(project);
  script_ = std::move(script);
  lines_ = project.lines;
  lines_text_ = lines_ == nullptr ? "" : bake::FormatLinesCsv(*lines_);
}

std::string Journal::Beginning() const {
  return std::string(kMagic) + Record("project", Dump(project_)) + Record("script", *script_) +
         (lines_ == nullptr ? "" : Record("lines", lines_text_));
}

Status Journal::Restart(const ProjectDocument& project, std::shared_ptr<const std::string> script) {
  const std::lock_guard lock(mutex_);
  ++newest_;
  Close();
  failed_ = true;
  Begin(project, std::move(script));
  // A record without changes marks the initial state as unsaved.
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(file_, Beginning() + Record("project-patch", "[]")));
  descriptor_ = Open();
  if (descriptor_ == nullptr) {
    return Status::Error(file_.string(), std::string("cannot be written: ") + std::strerror(errno));
  }
  failed_ = false;
  return Status();
}

void Journal::Discard(const ProjectDocument& project, std::shared_ptr<const std::string> script) {
  const std::lock_guard lock(mutex_);
  ++newest_;
  Close();
  failed_ = false;
  Begin(project, std::move(script));
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

Status Journal::Append(std::string_view header, std::string_view payload) {
  if (failed_) {
    return Status();  // The error was already reported.
  }
  if (descriptor_ == nullptr) {
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(file_, Beginning()));
    descriptor_ = Open();
  }
  const std::string record = Record(header, payload);
  size_t written = 0;
  while (descriptor_ != nullptr && written < record.size()) {
    const ssize_t count =
        ::write(descriptor_->get(), record.data() + written, record.size() - written);
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
  const std::lock_guard lock(mutex_);
  ++newest_;
  return WriteProject(now);
}

Status Journal::NoteGesture(std::shared_ptr<const ProjectDocument> now) {
  steps_.Put({++newest_, std::move(now)});
  const std::unique_lock lock(mutex_, std::try_to_lock);
  return lock ? std::exchange(failure_, Status()) : Status();
}

void Journal::WriteStep(const Step& step) {
  const std::lock_guard lock(mutex_);
  if (step.number == newest_) {
    if (Status status = WriteProject(*step.project); !status.ok()) {
      failure_ = std::move(status);
    }
  }
}

Status Journal::WriteProject(const ProjectDocument& now) {
  Json next = FormatProject(now);
  const Json patch = Json::diff(project_, next);
  if (!patch.empty()) {
    LARARIUM_RETURN_IF_ERROR(Append("project-patch", Dump(patch)));
    project_ = std::move(next);
  }
  return NoteLines(now);
}

// A table that cannot be read at the moment is not an edit: the last known lines stay.
Status Journal::NoteLines(const ProjectDocument& now) {
  if (now.lines == lines_ || now.lines == nullptr) {
    return Status();
  }
  std::string text = bake::FormatLinesCsv(*now.lines);
  if (lines_ == nullptr) {
    LARARIUM_RETURN_IF_ERROR(Append("lines", text));
  } else if (const drama::TextEdit edit = drama::Difference(lines_text_, text);
             !edit.removed.empty() || !edit.inserted.empty()) {
    LARARIUM_RETURN_IF_ERROR(Append(EditHeader("lines-edit", edit), edit.removed + edit.inserted));
  }
  lines_ = now.lines;
  lines_text_ = std::move(text);
  return Status();
}

Status Journal::NoteScript(const drama::TextEdit& edit) {
  const std::lock_guard lock(mutex_);
  return Append(EditHeader("script-edit", edit), edit.removed + edit.inserted);
}

Result<std::optional<JournalContent>> LoadJournal(const std::filesystem::path& file,
                                                  const bake::LineTable* lines) {
  if (!FileExists(file)) {
    return std::optional<JournalContent>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxBytes));
  const auto damaged = [&](std::string_view problem) {
    return Status::Error(file.string(), problem);
  };
  if (!text.starts_with(kMagic)) {
    return damaged("was not written by this version of Lararium");
  }
  Records records(std::string_view(text).substr(kMagic.size()));
  const auto project = records.Next();
  const auto script = records.Next();
  if (!project || project->kind != "project" || !script || script->kind != "script") {
    return damaged("is damaged at its beginning");
  }
  Replay replay;
  LARARIUM_ASSIGN_OR_RETURN(replay.project, ParseJson(project->payload, file.string()));
  replay.script = script->payload;
  JournalContent content;
  const std::string lines_in_file = lines == nullptr ? "" : bake::FormatLinesCsv(*lines);
  while (const auto entry = records.Next()) {
    if (!replay.Take(*entry)) {
      return damaged("holds an edit that does not fit those before it");
    }
    content.lines_are_ours |= replay.lines == lines_in_file;
  }
  content.edits = replay.edits;
  content.torn = records.torn();
  content.script = std::move(replay.script);
  LARARIUM_ASSIGN_OR_RETURN(content.project, ParseProject(replay.project, file.string()));
  if (replay.lines) {
    LARARIUM_ASSIGN_OR_RETURN(bake::LineTable table,
                              bake::ParseLinesCsv(*replay.lines, file.string()));
    content.project.lines = std::make_shared<const bake::LineTable>(std::move(table));
  }
  return std::optional<JournalContent>(std::move(content));
}

}  // namespace lararium::editor
