// Memory: large arrays in whole pages, so that a device that works in our memory can use them in place.
#ifndef CLRT_BASE_MEMORY_H
#define CLRT_BASE_MEMORY_H

#include "base/types.h"

// bytes of zeros. What fills a huge page (2 MiB) begins with one and is in huge pages where the system grants
// them; the rest begins with a page. NULL where there is no memory, and for no bytes.
void *page_alloc(u64 bytes);

// memory: from page_alloc with the same number of bytes, or NULL.
void page_free(void *memory, u64 bytes);

#endif
