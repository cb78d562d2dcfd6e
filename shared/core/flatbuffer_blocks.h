#pragma once

// Helpers for our FlatBuffers files, in which large arrays are vectors of structs that are read and
// written as blocks.

#include <flatbuffers/flatbuffers.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "shared/core/status.h"

namespace lararium {

static_assert(std::endian::native == std::endian::little, "blocks are copied as they are");

// Copies the vectors of one file. A valid file uses each of its bytes once. If the vectors add up
// to more than the file's size, they share bytes in order to exhaust memory: from then on nothing
// more is read, and ok() is false.
class BlockReader {
 public:
  explicit BlockReader(size_t file_size) : bytes_left_(file_size) {}

  bool ok() const { return ok_; }

  // Counts bytes of the file as used. Returns false if fewer bytes are left.
  bool Take(size_t bytes) {
    ok_ = ok_ && bytes <= bytes_left_;
    bytes_left_ -= ok_ ? bytes : 0;
    return ok_;
  }

  template <typename To, typename From>
  void Read(const flatbuffers::Vector<From>* from, std::vector<To>& to) {
    using Element = std::remove_cv_t<std::remove_pointer_t<From>>;
    static_assert(sizeof(Element) == sizeof(To) && std::is_trivially_copyable_v<To>);
    if (from != nullptr && from->size() > 0 && Take(from->size() * sizeof(To))) {
      const To* first = reinterpret_cast<const To*>(from->Data());
      to.assign(first, first + from->size());
    }
  }

  // Reads the first `wanted` elements if the vector has `all` elements. Otherwise reads the whole
  // vector, so that the validation of `to` reports the wrong size.
  template <typename To, typename From>
  void ReadFirst(const flatbuffers::Vector<From>* from,
                 size_t wanted,
                 size_t all,
                 std::vector<To>& to) {
    if (from == nullptr || from->size() != all || wanted >= all) {
      Read(from, to);
    } else if (Take(all * sizeof(To))) {
      const To* first = reinterpret_cast<const To*>(from->Data());
      to.assign(first, first + wanted);
    }
  }

  void Read(const flatbuffers::String* from, std::string& to) {
    if (from != nullptr && Take(from->size())) {
      to = from->str();
    }
  }

  void Read(const flatbuffers::Vector<flatbuffers::Offset<flatbuffers::String>>* from,
            std::vector<std::string>& to) {
    for (flatbuffers::uoffset_t i = 0; from != nullptr && i < from->size(); ++i) {
      if (!Take(sizeof(flatbuffers::uoffset_t))) {
        return;
      }
      Read(from->Get(i), to.emplace_back());
    }
  }

  // Reads one value of To from each table by read(table, *this, value).
  template <typename From, typename To, typename ReadTable>
  void ReadTables(const flatbuffers::Vector<flatbuffers::Offset<From>>* from,
                  std::vector<To>& to,
                  ReadTable read) {
    for (flatbuffers::uoffset_t i = 0; from != nullptr && i < from->size(); ++i) {
      if (!Take(sizeof(flatbuffers::uoffset_t))) {
        return;
      }
      read(*from->Get(i), *this, to.emplace_back());
    }
  }

 private:
  size_t bytes_left_;
  bool ok_ = true;
};

// A file type, for error messages.
struct FlatbufferKind {
  const char* extension;  // ".larprop"
  uint32_t version;
  const char* remedy;
};

// Returns the root of a file after its structure has been verified. `bytes` must be aligned as by
// malloc and outlive the root. Errors call the file `place`.
template <typename Root>
Result<const Root*> OpenFlatbuffer(std::span<const std::byte> bytes,
                                   const char* identifier,
                                   const FlatbufferKind& kind,
                                   const std::string& where) {
  if (bytes.size() < 8 || bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE ||
      !flatbuffers::BufferHasIdentifier(bytes.data(), identifier)) {
    return Status::Error(where, std::string("not a ") + kind.extension + " file", kind.remedy);
  }
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  if (!verifier.VerifyBuffer<Root>(identifier)) {
    return Status::Error(where, "the file is damaged or cut short", kind.remedy);
  }
  const Root* root = flatbuffers::GetRoot<Root>(bytes.data());
  if (root->version() != kind.version) {
    return Status::Error(where,
                         "version " + std::to_string(root->version()) +
                             " of the file is not supported (this program reads version " +
                             std::to_string(kind.version) + ")",
                         kind.remedy);
  }
  return root;
}

template <typename To, typename From>
auto WriteBlock(flatbuffers::FlatBufferBuilder& builder, const std::vector<From>& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<From>);
  To* block = nullptr;
  const auto offset = builder.CreateUninitializedVectorOfStructs<To>(from.size(), &block);
  if (!from.empty()) {
    std::memcpy(static_cast<void*>(block), from.data(), from.size() * sizeof(From));
  }
  return offset;
}

// Writes one table for each item by write(builder, item).
template <typename From, typename Write>
auto WriteTables(flatbuffers::FlatBufferBuilder& builder,
                 const std::vector<From>& from,
                 Write write) {
  std::vector<decltype(write(builder, std::declval<const From&>()))> tables;
  tables.reserve(from.size());
  for (const From& item : from) {
    tables.push_back(write(builder, item));
  }
  return builder.CreateVector(tables);
}

}  // namespace lararium
