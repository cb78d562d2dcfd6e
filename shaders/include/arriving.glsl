// The light that arrives at a surface of people and props, without the sun: from light transfer at
// the vertices, or unshadowed. The including file declares position_in_stage and the values of the
// transfer.

#include "surface.glsl"

uniform int has_transfer;

// front: true for the side that the vertices' normals point to. normal: normal of the lit side.
Arriving LightOn(vec3 normal, bool front) {
  Arriving arriving = Unshadowed(normal);
  if (has_transfer == 1) {
    if (front) {
      arriving = Transferred(transferred, transfer_share, transfer_open, normal);
    } else {
      arriving.irradiance *= back_share;
      arriving.open = dot(back_share, vec3(0.2126, 0.7152, 0.0722));
    }
  }
  // Light transfer contains the lamps' light already, with its shadows.
  int unlit = has_transfer == 1 ? 0 : lamp_count;
  for (int i = 0; i < unlit; ++i) {
    SeenLamp lamp = SeeLamp(i, position_in_stage);
    arriving.irradiance += lamp.irradiance * LampCosine(lamp, normal);
  }
  return arriving;
}
