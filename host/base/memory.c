#define _DEFAULT_SOURCE // MAP_ANONYMOUS, madvise

#include "base/memory.h"

#include <sys/mman.h>
#include <unistd.h>

static const u64 HUGE_PAGE = 2u << 20;

void *page_alloc(u64 bytes)
{
    if (bytes == 0 || bytes > SIZE_MAX - 2 * HUGE_PAGE)
        return NULL;
    const bool huge = bytes >= HUGE_PAGE;
    const size_t spare = huge ? HUGE_PAGE : 0;
    unsigned char *base =
        mmap(NULL, bytes + spare, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base == MAP_FAILED)
        return NULL;
    if (!huge)
        return base;
    // Address space beyond the alignment is given back. What is kept ends with a page, as munmap wants
    // addresses of pages.
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t kept = (bytes + page - 1) / page * page;
    const size_t before = (size_t)(-(uintptr_t)base & (HUGE_PAGE - 1));
    const size_t whole = (bytes + spare + page - 1) / page * page;
    if (before > 0)
        munmap(base, before);
    if (whole > before + kept)
        munmap(base + before + kept, whole - before - kept);
    madvise(base + before, kept, MADV_HUGEPAGE); // a wish; slower without, not wrong
    return base + before;
}

void page_free(void *memory, u64 bytes)
{
    if (memory)
        munmap(memory, bytes);
}
