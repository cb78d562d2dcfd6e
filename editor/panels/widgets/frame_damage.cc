#include "editor/panels/widgets/frame_damage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace lararium::panels {
namespace {

// Two rectangles are merged if this adds at most this share of their areas.
constexpr float kWaste = 0.25f;

bool Touch(const DamageRect& a, const DamageRect& b) {
  return a.from_x <= b.to_x && b.from_x <= a.to_x && a.from_y <= b.to_y && b.from_y <= a.to_y;
}

float AddedByUnion(const DamageRect& a, const DamageRect& b) {
  return Union(a, b).area() - a.area() - b.area();
}

}  // namespace

DamageRect Union(const DamageRect& a, const DamageRect& b) {
  if (a.empty() || b.empty()) {
    return a.empty() ? b : a;
  }
  return {std::min(a.from_x, b.from_x), std::min(a.from_y, b.from_y), std::max(a.to_x, b.to_x),
          std::max(a.to_y, b.to_y)};
}

DamageRect Intersection(const DamageRect& a, const DamageRect& b) {
  return {std::max(a.from_x, b.from_x), std::max(a.from_y, b.from_y), std::min(a.to_x, b.to_x),
          std::min(a.to_y, b.to_y)};
}

ImTextureID TextureOf(uint32_t id, uint32_t version) {
  static_assert(sizeof(ImTextureID) == sizeof(uint64_t));
  return reinterpret_cast<ImTextureID>(uint64_t{version} << 32 | id);  // NOLINT: a number
}

void FrameDamage::Copy(const ImDrawList& list, Layer& layer) {
  layer.name = list._OwnerName == nullptr ? "" : list._OwnerName;
  layer.vertices.assign(list.VtxBuffer.begin(), list.VtxBuffer.end());
  layer.indices.assign(list.IdxBuffer.begin(), list.IdxBuffer.end());
  layer.commands.assign(list.CmdBuffer.begin(), list.CmdBuffer.end());
}

bool FrameDamage::Same(const Layer& a, const Layer& b) {
  const auto same_bytes = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  const auto same_command = [](const ImDrawCmd& x, const ImDrawCmd& y) {
    return std::memcmp(&x.ClipRect, &y.ClipRect, sizeof(x.ClipRect)) == 0 &&
           x.TextureId == y.TextureId && x.VtxOffset == y.VtxOffset && x.IdxOffset == y.IdxOffset &&
           x.ElemCount == y.ElemCount;
  };
  return same_bytes(a.vertices, b.vertices) && same_bytes(a.indices, b.indices) &&
         std::equal(a.commands.begin(), a.commands.end(), b.commands.begin(), b.commands.end(),
                    same_command);
}

void FrameDamage::Read(const Layer& layer, std::vector<Triangle>& triangles) {
  triangles.clear();
  for (const ImDrawCmd& command : layer.commands) {
    for (unsigned int i = 0; i + 2 < command.ElemCount; i += 3) {
      Triangle& triangle = triangles.emplace_back();
      triangle.clip = command.ClipRect;
      triangle.texture = command.TextureId;
      for (unsigned int k = 0; k < 3; ++k) {
        const ImDrawIdx index = layer.indices[command.IdxOffset + i + k];
        triangle.corners[k] = layer.vertices[command.VtxOffset + index];
      }
    }
  }
}

bool FrameDamage::Same(const Triangle& a, const Triangle& b) {
  return std::memcmp(a.corners, b.corners, sizeof(a.corners)) == 0 &&
         std::memcmp(&a.clip, &b.clip, sizeof(a.clip)) == 0 && a.texture == b.texture;
}

void FrameDamage::AddTriangle(const Triangle& triangle) {
  const ImVec2& a = triangle.corners[0].pos;
  const ImVec2& b = triangle.corners[1].pos;
  const ImVec2& c = triangle.corners[2].pos;
  const DamageRect box{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                       std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
  AddRect(Intersection(box, {triangle.clip.x, triangle.clip.y, triangle.clip.z, triangle.clip.w}));
}

void FrameDamage::AddRect(const DamageRect& rect) {
  DamageRect whole = Intersection({std::floor(rect.from_x), std::floor(rect.from_y),
                                   std::ceil(rect.to_x), std::ceil(rect.to_y)},
                                  {0.0f, 0.0f, size_.x, size_.y});
  if (whole.empty()) {
    return;
  }
  // The enlarged rectangle can touch others.
  for (size_t i = 0; i < rects_.size();) {
    const bool joins = Touch(rects_[i], whole) &&
                       AddedByUnion(rects_[i], whole) <= kWaste * (rects_[i].area() + whole.area());
    if (!joins) {
      ++i;
      continue;
    }
    whole = Union(rects_[i], whole);
    rects_[i] = rects_.back();
    rects_.pop_back();
    i = 0;
  }
  rects_.push_back(whole);
  if (rects_.size() <= kMostRects) {
    return;
  }
  size_t best_a = 0, best_b = 1;
  for (size_t a = 0; a < rects_.size(); ++a) {
    for (size_t b = a + 1; b < rects_.size(); ++b) {
      if (AddedByUnion(rects_[a], rects_[b]) < AddedByUnion(rects_[best_a], rects_[best_b])) {
        best_a = a;
        best_b = b;
      }
    }
  }
  rects_[best_a] = Union(rects_[best_a], rects_[best_b]);
  rects_.erase(rects_.begin() + static_cast<ptrdiff_t>(best_b));
}

// Finds triangles that both layers have, even when others were inserted or removed before them.
void FrameDamage::Compare(const Layer& before, const Layer& now) {
  if (Same(before, now)) {
    return;
  }
  Read(before, triangles_before_);
  Read(now, triangles_now_);
  const std::vector<Triangle>& a = triangles_before_;
  const std::vector<Triangle>& b = triangles_now_;
  const size_t shorter = std::min(a.size(), b.size());
  size_t head = 0;
  while (head < shorter && Same(a[head], b[head])) {
    ++head;
  }
  size_t tail = 0;
  while (tail < shorter - head && Same(a[a.size() - 1 - tail], b[b.size() - 1 - tail])) {
    ++tail;
  }
  const bool parallel = a.size() == b.size();
  for (size_t i = head; i + tail < a.size(); ++i) {
    if (!parallel || !Same(a[i], b[i])) {
      AddTriangle(a[i]);
    }
  }
  for (size_t i = head; i + tail < b.size(); ++i) {
    if (!parallel || !Same(a[i], b[i])) {
      AddTriangle(b[i]);
    }
  }
}

bool FrameDamage::CompareLayers() {
  static const Layer kNone;
  const auto find = [](const std::vector<Layer>& layers, size_t begin, const std::string& name) {
    return static_cast<size_t>(
        std::find_if(layers.begin() + static_cast<ptrdiff_t>(begin), layers.end(),
                     [&](const Layer& layer) { return layer.name == name; }) -
        layers.begin());
  };
  size_t next = 0;  // Index into the triangles of the last frame.
  for (const Layer& now : now_) {
    const size_t match = find(before_, next, now.name);
    if (match == before_.size()) {
      if (find(before_, 0, now.name) < next) {
        return false;
      }
      Compare(kNone, now);
      continue;
    }
    for (; next < match; ++next) {
      Compare(before_[next], kNone);
    }
    Compare(before_[next++], now);
  }
  for (; next < before_.size(); ++next) {
    Compare(before_[next], kNone);
  }
  return true;
}

std::span<const DamageRect> FrameDamage::Next(const ImDrawData& frame) {
  rects_.clear();
  now_.resize(static_cast<size_t>(frame.CmdListsCount));
  for (size_t i = 0; i < now_.size(); ++i) {
    Copy(*frame.CmdLists[i], now_[i]);
  }
  const bool same_size = frame.DisplaySize.x == size_.x && frame.DisplaySize.y == size_.y;
  size_ = frame.DisplaySize;
  if (!known_ || !same_size || !CompareLayers()) {
    rects_.clear();
    AddRect({0.0f, 0.0f, size_.x, size_.y});
  }
  known_ = true;
  std::swap(before_, now_);
  return rects_;
}

}  // namespace lararium::panels
