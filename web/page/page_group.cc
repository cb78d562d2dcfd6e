#include "web/page/page_group.h"

namespace lararium::web {

void PageGroup::Take(const std::string& from, std::string_view bytes) {
  (void)relay_.TakeMessage(from, bytes, steady_());
}

void PageGroup::Want(group::GroupWish::What what, const std::string& marker, bool to_all) {
  if (relay_.member().has_player()) {
    relay_.member().Want(what, marker, to_all, steady_());
  }
}

void PageGroup::Step() {
  const int64_t now = steady_();
  relay_.TakeOwn(feed_.TakeOwn(), now);
  relay_.Step(now);
  for (const std::string& news : relay_.TakeForPlayer(now)) {
    feed_.Take(news);
  }
  relay_.member().TakeNotes();  // A page has no log.
}

}  // namespace lararium::web
