// Reading PFM files: floats as they are, grey ("Pf") or RGB ("PF"), of either byte order.
#ifndef CLRT_IMAGE_PFM_H
#define CLRT_IMAGE_PFM_H

#include "image/image.h"

// The caller destroys the image. Values are the stored ones; the scale's magnitude is not applied.
// NULL with ERROR_IO (missing, broken, cut short, or longer than its header says) or ERROR_MEMORY;
// the text names the path.
Image *pfm_image_read(const char *path, Error *error);

#endif
