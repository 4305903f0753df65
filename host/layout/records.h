// Lights, materials, textures and the camera of a scene as device records.
#ifndef CLRT_LAYOUT_RECORDS_H
#define CLRT_LAYOUT_RECORDS_H

#include "scene/scene.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/params.h"

// Render space: camera is the position that becomes the origin.
LightRecord light_record(const Light *light, Vec3 camera);

// Whether light may pass through a surface of this material.
bool material_transmits(const Material *material);
MaterialRecord material_record(const Material *material, Vec3 ambient_light);
TextureRecord texture_record(const Texture *texture);

// The camera, image size and limits of a scene; crop = the whole image.
RenderParams camera_params(const Scene *scene);

#endif
