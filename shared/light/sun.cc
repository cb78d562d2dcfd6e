#include "shared/light/sun.h"

#include "shared/core/json_fields.h"

namespace lararium::light {

void DescribeFields(Fields& fields, Sun& sun) {
  fields.Numbers("direction", std::span(&sun.direction.x, 3));
  fields.Numbers("irradiance", std::span(&sun.irradiance.x, 3));
  fields.Number("angular_radius", sun.angular_radius, 0.0, kMaxSunRadius);
}

}  // namespace lararium::light
