// Identity: what made an image, and the options that make it again. In the text chunks of PNGs and in the
// statistics; no times, no folders, so that the same command on the same device gives the same file.
#ifndef CLRT_CLI_IDENTITY_H
#define CLRT_CLI_IDENTITY_H

#include "budget/budget.h"
#include "device/list.h"
#include "layout/features.h"
#include "output/output.h"
#include "scene/scene.h"

typedef struct Identity {
    const char *scene_name; // last part of its path
    u64 scene_hash;         // assets/fingerprint.h
    const Scene *scene;     // with the overrides of the command line
    const DeviceInfo *device;
    const char *math;       // as --math has it
    u32 bits;               // of a PNG
    f32 clamp;              // RenderJob.clamp
    bool cropped;
    u32 left, top, width, height; // of the crop
} Identity;

// The part of a path after its last slash.
const char *identity_base_name(const char *path);

// Texts of an image, with the room that they take.
#define IDENTITY_TEXTS 16
typedef struct IdentityTexts {
    OutputText texts[IDENTITY_TEXTS];
    size_t count;
    char room[8192]; // what does not fit is cut
    size_t used;
} IdentityTexts;

// What is known before the image: program, scene, device, options.
void identity_texts(const Identity *identity, IdentityTexts *texts);

// What is known after it: the features of its program, the hash of that, the error budget.
void identity_closing_texts(FeatureSet features, u64 program_hash, const ErrorBudget *budget,
                            IdentityTexts *texts);

#endif
