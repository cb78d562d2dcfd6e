#include "shared/bundle/zip_reader.h"

#include <algorithm>
#include <set>

#include "shared/bundle/member_name.h"
#include "shared/bundle/zip_layout.h"

namespace lararium::bundle {
namespace {

constexpr char kExportAgain[] = "export the bundle with lararium-editor";

// Reads consecutive little-endian values.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

  uint16_t Read16() { return static_cast<uint16_t>(Read(2)); }
  uint32_t Read32() { return Read(4); }

 private:
  uint32_t Read(size_t count) {
    CHECK(position_ + count <= bytes_.size());
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) {
      value |= std::to_integer<uint32_t>(bytes_[position_ + i]) << (8 * i);
    }
    position_ += count;
    return value;
  }

  std::span<const std::byte> bytes_;
  size_t position_ = 0;
};

// The checked fields of a central or of a local file header. Fields that a header does not have
// keep the values that they must have.
struct FileHeader {
  uint32_t signature = 0;
  uint16_t version_made_by = kVersionMadeBy;
  uint16_t version_needed = 0;
  uint16_t flags = 0;
  uint16_t method = 0;
  uint16_t time = 0;
  uint16_t date = 0;
  uint32_t crc32 = 0;
  uint32_t compressed_size = 0;
  uint32_t size = 0;
  uint16_t name_size = 0;
  uint16_t extra_size = 0;
  uint16_t comment_size = 0;
  uint16_t disk = 0;
  uint16_t internal_attributes = 0;
  uint32_t external_attributes = 0;
  uint32_t offset = 0;
};

void ReadCommon(Cursor& cursor, FileHeader& header) {
  header.version_needed = cursor.Read16();
  header.flags = cursor.Read16();
  header.method = cursor.Read16();
  header.time = cursor.Read16();
  header.date = cursor.Read16();
  header.crc32 = cursor.Read32();
  header.compressed_size = cursor.Read32();
  header.size = cursor.Read32();
  header.name_size = cursor.Read16();
  header.extra_size = cursor.Read16();
}

FileHeader ReadLocal(std::span<const std::byte> bytes) {
  Cursor cursor(bytes);
  FileHeader header;
  header.signature = cursor.Read32();
  ReadCommon(cursor, header);
  return header;
}

FileHeader ReadCentral(std::span<const std::byte> bytes) {
  Cursor cursor(bytes);
  FileHeader header;
  header.signature = cursor.Read32();
  header.version_made_by = cursor.Read16();
  ReadCommon(cursor, header);
  header.comment_size = cursor.Read16();
  header.disk = cursor.Read16();
  header.internal_attributes = cursor.Read16();
  header.external_attributes = cursor.Read32();
  header.offset = cursor.Read32();
  return header;
}

// True if the fields that are equal in every header of a bundle have their values.
bool HasFixedFields(const FileHeader& header) {
  return header.version_made_by == kVersionMadeBy && header.version_needed == kVersionNeeded &&
         header.flags == 0 && header.method == 0 && header.time == kDosTime &&
         header.date == kDosDate && header.compressed_size == header.size &&
         header.comment_size == 0 && header.disk == 0 && header.internal_attributes == 0 &&
         header.external_attributes == 0;
}

std::string_view Text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Returns a name for a message, without characters that could disturb a terminal.
std::string Printable(std::string_view name) {
  std::string text(name.substr(0, kMaxMemberName));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

// Reads one archive from its first member to its last.
class Reader {
 public:
  Reader(std::span<const std::byte> file, const std::string& where) : file_(file), place_(where) {}

  Result<std::vector<ZipMember>> Read() {
    LARARIUM_RETURN_IF_ERROR(ReadEnd());
    std::vector<ZipMember> members;
    members.reserve(count_);
    for (size_t i = 0; i < count_; ++i) {
      LARARIUM_ASSIGN_OR_RETURN(const ZipMember member, ReadMember());
      members.push_back(member);
    }
    if (central_ != file_.size() - kEndSize || next_ != central_begin_) {
      return Damaged("there are bytes that belong to no member");
    }
    return members;
  }

 private:
  Status Damaged(std::string_view what) const {
    return Status::Error(place_, "the bundle is damaged: " + std::string(what), kCopyAgain);
  }
  Status Foreign(std::string_view what) const {
    return Status::Error(place_, "not a bundle of this program: " + std::string(what),
                         kExportAgain);
  }

  // The end of central directory record: the last bytes of the file.
  Status ReadEnd() {
    if (file_.empty()) {
      return Status::Error(place_, "the file is empty", kCopyAgain);
    }
    constexpr std::byte kMagic[] = {std::byte{'P'}, std::byte{'K'}};
    if (file_.size() < 2 || !std::equal(std::begin(kMagic), std::end(kMagic), file_.begin())) {
      return Status::Error(place_, "not a bundle", "name a .larshow file");
    }
    if (file_.size() > kMaxBundleBytes) {
      return Foreign("larger than 4 GiB");
    }
    if (file_.size() < kEndSize || Cursor(file_.last(kEndSize)).Read32() != kEndSignature) {
      return Damaged("its end is missing");
    }
    Cursor end(file_.last(kEndSize).subspan(4));
    const uint16_t disk = end.Read16();
    const uint16_t central_disk = end.Read16();
    const uint16_t count_on_disk = end.Read16();
    count_ = end.Read16();
    const uint64_t central_size = end.Read32();
    central_begin_ = end.Read32();
    const uint16_t comment_size = end.Read16();
    if (disk != 0 || central_disk != 0 || count_on_disk != count_ || comment_size != 0 ||
        central_begin_ + central_size != file_.size() - kEndSize) {
      return Damaged("its directory is not where it should be");
    }
    if (count_ > kMaxMembers) {
      return Foreign("more than " + std::to_string(kMaxMembers) + " members");
    }
    central_ = central_begin_;
    return Status();
  }

  Result<ZipMember> ReadMember() {
    const std::span<const std::byte> rest =
        file_.first(file_.size() - kEndSize).subspan(static_cast<size_t>(central_));
    if (rest.size() < kCentralSize) {
      return Damaged("its directory is too short");
    }
    const FileHeader header = ReadCentral(rest);
    if (header.signature != kCentralSignature || rest.size() - kCentralSize < header.name_size) {
      return Damaged("its directory is broken");
    }
    const std::string_view name = Text(rest.subspan(kCentralSize, header.name_size));
    LARARIUM_RETURN_IF_ERROR(CheckHeader(header, name));
    LARARIUM_RETURN_IF_ERROR(CheckLocalHeader(header, name));
    const uint64_t data = next_ + kLocalSize + name.size() + ExtraSize(next_, name.size());
    central_ += kCentralSize + name.size();
    next_ = data + header.size;
    return ZipMember{name, file_.subspan(static_cast<size_t>(data), header.size), header.crc32};
  }

  Status CheckHeader(const FileHeader& header, std::string_view name) {
    if (!IsMemberName(name)) {
      return Foreign("the member name '" + Printable(name) + "' is not allowed");
    }
    if (!names_.insert(name).second) {
      return Foreign("two members are called '" + std::string(name) + "'");
    }
    if (header.method != 0 || (header.flags & 1) != 0) {
      return Foreign("the member '" + std::string(name) + "' is compressed or encrypted");
    }
    if (!HasFixedFields(header) || header.extra_size != 0 || header.offset != next_) {
      return Damaged("the directory entry of '" + std::string(name) + "' is wrong");
    }
    return Status();
  }

  // Checks that the local header equals the directory's, that the extra field aligns the data, and
  // that the data end before the directory begins.
  Status CheckLocalHeader(const FileHeader& central, std::string_view name) const {
    const Status damaged = Damaged("the header of '" + std::string(name) + "' is wrong");
    const size_t extra_size = ExtraSize(next_, name.size());
    const uint64_t header_size = kLocalSize + name.size() + extra_size;
    if (next_ + header_size + central.size > central_begin_) {
      return Damaged("the member '" + std::string(name) + "' is cut short");
    }
    const std::span<const std::byte> bytes =
        file_.subspan(static_cast<size_t>(next_), static_cast<size_t>(header_size));
    const FileHeader local = ReadLocal(bytes);
    const bool same = local.signature == kLocalSignature && HasFixedFields(local) &&
                      local.crc32 == central.crc32 && local.size == central.size &&
                      local.name_size == name.size() && local.extra_size == extra_size &&
                      Text(bytes.subspan(kLocalSize, name.size())) == name;
    if (!same) {
      return damaged;
    }
    Cursor extra(bytes.last(extra_size));
    const bool aligns = extra.Read16() == kAlignmentField &&
                        extra.Read16() == extra_size - kExtraHeaderSize &&
                        extra.Read16() == kAlignment;
    const auto padding = bytes.last(extra_size - kExtraHeaderSize - 2);
    const bool zero =
        std::all_of(padding.begin(), padding.end(), [](std::byte b) { return b == std::byte{0}; });
    return aligns && zero ? Status() : damaged;
  }

  std::span<const std::byte> file_;
  const std::string& place_;
  size_t count_ = 0;
  uint64_t central_begin_ = 0;
  uint64_t central_ = 0;  // offset of the next directory entry
  uint64_t next_ = 0;     // required offset of the next local header
  std::set<std::string_view> names_;
};

}  // namespace

Result<std::vector<ZipMember>> ReadZip(std::span<const std::byte> file, const std::string& where) {
  return Reader(file, where).Read();
}

}  // namespace lararium::bundle
