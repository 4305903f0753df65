// Lights, materials and the camera of a scene as device records.
#ifndef CLRT_LAYOUT_RECORDS_H
#define CLRT_LAYOUT_RECORDS_H

#include "scene/scene.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/params.h"
#include "shared/texture.h"

// Render space: camera is the position that becomes the origin. Without what is of a sample.
LightRecord light_record(const Light *light, Vec3 camera);

// Whether light may pass through a surface of this material.
bool material_transmits(const Material *material);
// Whether textures say how much passes.
bool material_transmits_textured(const Material *material);
// Whether rays may be mirrored by it.
bool material_mirrors(const Material *material);
// ambient_light: the ambient intensity as it counts for this material.
MaterialRecord material_record(const Material *material, Vec3 ambient_light);

// The camera, image size and limits of a scene; crop = the whole image.
RenderParams camera_params(const Scene *scene);

#endif
