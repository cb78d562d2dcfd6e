#pragma once

// The names of the JSON types, for headers that only mention them. A source that uses the types
// includes shared/core/json.h, which is far heavier.

#include <nlohmann/json_fwd.hpp>

namespace lararium {

using Json = nlohmann::json;  // Keys are sorted, so that files diff well.

class Fields;
class JsonView;

}  // namespace lararium
