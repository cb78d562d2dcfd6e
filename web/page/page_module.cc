// The functions that JavaScript calls (show.js). Those that can fail return web::ErrorText().

#include <emscripten/emscripten.h>

#include "shared/core/json.h"
#include "web/page/page_show.h"
#include "web/page/room_view.h"
#include "web/tracker/error_text.h"

using lararium::web::ErrorText;
using lararium::web::PageShow;
using lararium::web::PixelFormat;
using lararium::web::RoomFromEye;
using lararium::web::RoomView;

namespace {

std::unique_ptr<PageShow> show;
std::string names;                                      // The result of lararium_names().
std::vector<lararium::vision::OccluderMesh> occluders;  // Found by lararium_find_occluders().
std::string state;  // The result of lararium_state() or lararium_group_state().
lararium::web::PageGroup* page_group = nullptr;  // The one of `show`.
std::vector<lararium::group::GroupMember::Outgoing> outgoing;

const char* TakeNames(const lararium::Result<std::vector<std::string>>& found) {
  names.clear();
  for (size_t i = 0; found.ok() && i < found->size(); ++i) {
    names += (*found)[i] + "\n";
  }
  return ErrorText(found.status());
}

lararium::show::LanguageChoice Languages(const char* spoken,
                                         const char* captions,
                                         const char* read) {
  return {spoken, captions, false, read};
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* lararium_open(const char* manifest,
                                               size_t manifest_size,
                                               const std::byte* signature,
                                               size_t signature_size,
                                               const char* key,
                                               size_t key_size) {
  auto opened =
      PageShow::Open({manifest, manifest_size}, {signature, signature_size}, {key, key_size});
  if (!opened.ok()) {
    return ErrorText(opened.status());
  }
  show = *std::move(opened);
  return nullptr;
}

// Languages: see show::LanguageChoice.
EMSCRIPTEN_KEEPALIVE const char* lararium_find_missing(int stage,
                                                       const char* spoken,
                                                       const char* captions,
                                                       const char* read) {
  return TakeNames(
      show->FindMissing(static_cast<PageShow::Stage>(stage), Languages(spoken, captions, read)));
}

// Verifies the manifest of another version of the show.
EMSCRIPTEN_KEEPALIVE const char* lararium_find_needed(const char* manifest,
                                                      size_t manifest_size,
                                                      const std::byte* signature,
                                                      size_t signature_size,
                                                      const char* key,
                                                      size_t key_size,
                                                      const char* spoken,
                                                      const char* captions,
                                                      const char* read) {
  auto opened =
      PageShow::Open({manifest, manifest_size}, {signature, signature_size}, {key, key_size});
  return opened.ok() ? TakeNames((*opened)->FindMissing(PageShow::Stage::kShow,
                                                        Languages(spoken, captions, read)))
                     : ErrorText(opened.status());
}

// The names that the last of these functions has found, one a line.
EMSCRIPTEN_KEEPALIVE const char* lararium_names() { return names.c_str(); }

EMSCRIPTEN_KEEPALIVE std::byte* lararium_new_piece(size_t size) { return show->NewPiece(size); }

EMSCRIPTEN_KEEPALIVE const char* lararium_add_piece(const char* member) {
  return ErrorText(show->AddPiece(member));
}

EMSCRIPTEN_KEEPALIVE size_t lararium_map_count() { return show->map_count(); }

// Writes address and size of a map.
EMSCRIPTEN_KEEPALIVE const char* lararium_map(size_t index, uint32_t* address_and_size) {
  const auto map = show->map(index);
  if (!map.ok()) {
    return ErrorText(map.status());
  }
  address_and_size[0] = reinterpret_cast<uintptr_t>(map->data());
  address_and_size[1] = map->size();
  return nullptr;
}

// Returns how many occluders a place has.
EMSCRIPTEN_KEEPALIVE size_t lararium_find_occluders(size_t place) {
  occluders = show->occluders(place);
  return occluders.size();
}

// Writes address and number of the positions, and address and number of the indices, of an occluder
// of the last place that was asked for.
EMSCRIPTEN_KEEPALIVE void lararium_occluder(size_t index, uint32_t* found) {
  const lararium::vision::OccluderMesh& mesh = occluders[index];
  found[0] = reinterpret_cast<uintptr_t>(mesh.positions.data());
  found[1] = mesh.positions.size();
  found[2] = reinterpret_cast<uintptr_t>(mesh.indices.data());
  found[3] = mesh.indices.size();
}

EMSCRIPTEN_KEEPALIVE const char* lararium_load_guide(const char* spoken,
                                                     const char* captions,
                                                     const char* read) {
  return ErrorText(show->LoadGuide(Languages(spoken, captions, read)));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_load(const char* spoken,
                                               const char* captions,
                                               const char* read) {
  return ErrorText(show->Load(Languages(spoken, captions, read)));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_load_people() { return ErrorText(show->LoadPeople()); }

EMSCRIPTEN_KEEPALIVE const char* lararium_load_things() { return ErrorText(show->LoadThings()); }

EMSCRIPTEN_KEEPALIVE const char* lararium_load_voices(const char* spoken,
                                                      const char* captions,
                                                      const char* read) {
  return ErrorText(show->LoadVoices(Languages(spoken, captions, read)));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_set_languages(const char* spoken,
                                                        const char* captions,
                                                        const char* read) {
  return ErrorText(show->SetLanguages(Languages(spoken, captions, read)));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_open_sound() { return ErrorText(show->OpenSound()); }

EMSCRIPTEN_KEEPALIVE double lararium_length() { return show->length(); }

EMSCRIPTEN_KEEPALIVE const char* lararium_language() { return show->language().c_str(); }

EMSCRIPTEN_KEEPALIVE void lararium_choose(bool descriptions, bool reduced_motion) {
  show->input().SetDescriptions(descriptions);
  show->input().SetReducedMotion(reduced_motion);
}

// A key by its name, as render::KeyName() has it.
EMSCRIPTEN_KEEPALIVE void lararium_press_key(const char* key) { show->input().PressKey(key); }

EMSCRIPTEN_KEEPALIVE void lararium_restart() { show->input().RestartAt(0.0); }

// The functions of the group may be called after lararium_join_group() has returned true.
EMSCRIPTEN_KEEPALIVE bool lararium_join_group(const char* name, uint32_t boot, uint32_t more_boot) {
  page_group = show->JoinGroup(name, uint64_t{more_boot} << 32 | boot);
  return page_group != nullptr;
}

EMSCRIPTEN_KEEPALIVE void lararium_take_message(const char* from, const char* bytes, size_t size) {
  page_group->Take(from, {bytes, size});
}

EMSCRIPTEN_KEEPALIVE void lararium_set_gone(const char* name) { page_group->SetGone(name); }

// what: GroupWish::What
EMSCRIPTEN_KEEPALIVE void lararium_want(int what, const char* marker, bool to_all) {
  page_group->Want(static_cast<lararium::group::GroupWish::What>(what), marker, to_all);
}

// Returns the number of messages to be sent.
EMSCRIPTEN_KEEPALIVE size_t lararium_step_group() {
  page_group->Step();
  outgoing = page_group->TakeOutgoing();
  return outgoing.size();
}

// Writes address and size of a message's bytes, and whether it has to arrive. Returns the name of
// the member that gets it; "": all do.
EMSCRIPTEN_KEEPALIVE const char* lararium_outgoing(size_t index, uint32_t* message) {
  const auto& [to, bytes, reliable] = outgoing[index];
  message[0] = reinterpret_cast<uintptr_t>(bytes.data());
  message[1] = bytes.size();
  message[2] = reliable ? 1 : 0;
  return to.c_str();
}

// Returns PageGroup::State() as JSON.
EMSCRIPTEN_KEEPALIVE const char* lararium_group_state() {
  state = lararium::DumpJson(page_group->State());
  return state.c_str();
}

EMSCRIPTEN_KEEPALIVE void lararium_hold(bool holds) { show->Hold(holds); }

EMSCRIPTEN_KEEPALIVE void lararium_go_to(const char* marker) { show->GoTo(marker); }

// Returns PageShow::DescribeState() as JSON.
EMSCRIPTEN_KEEPALIVE const char* lararium_state() {
  state = lararium::DumpJson(show->DescribeState());
  return state.c_str();
}

EMSCRIPTEN_KEEPALIVE void lararium_forget_pose() { show->input().ForgetPose(); }

EMSCRIPTEN_KEEPALIVE uint8_t* lararium_new_image(int format, int width, int height) {
  return show->NewImage(static_cast<PixelFormat>(format), width, height);
}

EMSCRIPTEN_KEEPALIVE const uint8_t* lararium_luminance() { return show->ComputeLuminance().data; }

EMSCRIPTEN_KEEPALIVE double* lararium_new_seen(size_t count) { return show->NewSeen(count); }

EMSCRIPTEN_KEEPALIVE const char* lararium_draw(
    const double* tracked, double seconds, float hour, double late_ms, float shown) {
  return ErrorText(
      show->Draw({tracked, PageShow::kTrackedNumbers}, {seconds, hour, late_ms, shown}));
}

EMSCRIPTEN_KEEPALIVE size_t lararium_view_count() { return show->view_count(); }

// Writes width and height of a view's picture.
EMSCRIPTEN_KEEPALIVE void lararium_view_size(size_t index, uint32_t* width_and_height) {
  const cv::Mat& picture = show->view_picture(index);
  width_and_height[0] = static_cast<uint32_t>(picture.cols);
  width_and_height[1] = static_cast<uint32_t>(picture.rows);
}

EMSCRIPTEN_KEEPALIVE const uint8_t* lararium_view_picture(size_t index) {
  return show->view_picture(index).data;
}

EMSCRIPTEN_KEEPALIVE const char* lararium_draw_view(
    size_t index, double seconds, float hour, double late_ms, float shown) {
  return ErrorText(show->DrawView(index, {seconds, hour, late_ms, shown}));
}

EMSCRIPTEN_KEEPALIVE void lararium_enter_room(bool sees) { show->EnterRoom(sees); }

// viewer: the first seven numbers of RoomView::kNumbers.
EMSCRIPTEN_KEEPALIVE void lararium_find_stage(const double* tracked,
                                              const double* viewer,
                                              double seconds) {
  show->FindStage({tracked, PageShow::kTrackedNumbers}, RoomFromEye({viewer, 7}), seconds);
}

// numbers: RoomView::kNumbers for each view.
EMSCRIPTEN_KEEPALIVE const char* lararium_draw_in_room(const double* numbers,
                                                       size_t view_count,
                                                       uint32_t framebuffer,
                                                       double seconds,
                                                       float hour,
                                                       double late_ms,
                                                       float shown) {
  std::vector<RoomView> views;
  for (size_t i = 0; i < view_count; ++i) {
    views.push_back(RoomView::FromNumbers({numbers + i * RoomView::kNumbers, RoomView::kNumbers}));
  }
  return ErrorText(show->DrawInRoom(views, framebuffer, {seconds, hour, late_ms, shown}));
}

EMSCRIPTEN_KEEPALIVE double lararium_time() { return show->time(); }

// Returns PageShow::TakeTexts() as JSON.
EMSCRIPTEN_KEEPALIVE const char* lararium_texts() {
  const std::string* texts = show->TakeTexts();
  return texts == nullptr ? nullptr : texts->c_str();
}

}  // extern "C"
