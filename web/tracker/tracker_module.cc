// The functions that JavaScript calls (lararium-tracker.js). Those that can fail return
// ErrorText().

#include <emscripten/emscripten.h>

#include "web/tracker/error_text.h"
#include "web/tracker/tracker_session.h"

using lararium::web::ErrorText;
using lararium::web::PostedSearch;
using lararium::web::TrackerSession;

extern "C" {

EMSCRIPTEN_KEEPALIVE TrackerSession* lararium_open(bool posted_search) {
  return new TrackerSession(posted_search);
}

EMSCRIPTEN_KEEPALIVE void lararium_close(TrackerSession* session) { delete session; }

EMSCRIPTEN_KEEPALIVE const char* lararium_add_map(TrackerSession* session,
                                                  const std::byte* bytes,
                                                  size_t size) {
  return ErrorText(session->AddMap({bytes, size}));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_set_intrinsics(
    TrackerSession* session, const double* numbers, size_t count, int width, int height) {
  return ErrorText(session->SetIntrinsics({numbers, count}, width, height));
}

// positions: x, y, z of each.
EMSCRIPTEN_KEEPALIVE const char* lararium_add_occluder(TrackerSession* session,
                                                       size_t map,
                                                       const Eigen::Vector3f* positions,
                                                       size_t position_count,
                                                       const uint32_t* indices,
                                                       size_t index_count) {
  return ErrorText(session->AddOccluder(
      map, {{positions, positions + position_count}, {indices, indices + index_count}}));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_warm_up(TrackerSession* session) {
  return ErrorText(session->WarmUp());
}

EMSCRIPTEN_KEEPALIVE uint8_t* lararium_new_image(TrackerSession* session, int width, int height) {
  return session->NewImage(width, height);
}

EMSCRIPTEN_KEEPALIVE const char* lararium_track(TrackerSession* session, double seconds) {
  return ErrorText(session->Track(seconds));
}

EMSCRIPTEN_KEEPALIVE const double* lararium_tracked(TrackerSession* session) {
  return session->tracked().data();
}

// Writes the number of numbers.
EMSCRIPTEN_KEEPALIVE const double* lararium_seen(TrackerSession* session, size_t* count) {
  const std::span<const double> seen = session->seen();
  *count = seen.size();
  return seen.data();
}

EMSCRIPTEN_KEEPALIVE void lararium_relocalize(TrackerSession* session) { session->Relocalize(); }

// The number of numbers in the question that waits to be posted; 0 if there is none.
EMSCRIPTEN_KEEPALIVE size_t lararium_question_size(TrackerSession* session) {
  const PostedSearch* search = session->search();
  return search == nullptr ? 0 : search->question().size();
}

EMSCRIPTEN_KEEPALIVE const double* lararium_question(TrackerSession* session) {
  return session->search()->question().data();
}

EMSCRIPTEN_KEEPALIVE const uint8_t* lararium_question_image(TrackerSession* session) {
  return session->search()->image().data;
}

EMSCRIPTEN_KEEPALIVE void lararium_posted(TrackerSession* session) { session->search()->Posted(); }

EMSCRIPTEN_KEEPALIVE const char* lararium_answer(TrackerSession* session,
                                                 const double* numbers,
                                                 size_t count) {
  return session->search() == nullptr ? nullptr
                                      : ErrorText(session->search()->Answer({numbers, count}));
}

EMSCRIPTEN_KEEPALIVE const char* lararium_find(TrackerSession* session,
                                               const double* question,
                                               size_t count) {
  return ErrorText(session->Find({question, count}));
}

EMSCRIPTEN_KEEPALIVE size_t lararium_found_size(TrackerSession* session) {
  return session->found().size();
}

EMSCRIPTEN_KEEPALIVE const double* lararium_found(TrackerSession* session) {
  return session->found().data();
}

}  // extern "C"
