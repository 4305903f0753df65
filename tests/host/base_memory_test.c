// Pages: aligned, zero, writable to the last byte, and given back.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"

static void test_pages(void **state)
{
    (void)state;
    static const u64 sizes[] = {1, 4095, 4096, 4097, (2 << 20) - 1, 2 << 20, (2 << 20) + 1, (6 << 20) + 12345};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned char *memory = page_alloc(sizes[i]);
        assert_non_null(memory);
        assert_int_equal((uintptr_t)memory % (sizes[i] < 2 << 20 ? 4096 : 2 << 20), 0);
        for (u64 k = 0; k < sizes[i]; k += 511)
            assert_int_equal(memory[k], 0);
        memset(memory, 1, sizes[i]);
        page_free(memory, sizes[i]);
    }
}

static void test_none(void **state)
{
    (void)state;
    assert_null(page_alloc(0));
    assert_null(page_alloc(UINT64_MAX));
    assert_null(page_alloc((u64)1 << 62));
    page_free(NULL, 0);
    page_free(NULL, 100);
}

// Pages in use by the program.
static long pages_mapped(void)
{
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld", &pages) != 1)
        pages = -1;
    if (file)
        fclose(file);
    return pages;
}

static void test_given_back(void **state)
{
    (void)state;
    const u64 size = (16 << 20) + 100;
    const long before = pages_mapped();
    if (before < 0)
        skip();
    for (int i = 0; i < 100; i++)
        page_free(page_alloc(size), size);
    assert_true(pages_mapped() - before < (long)(size / 4096));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pages), cmocka_unit_test(test_none),
                                       cmocka_unit_test(test_given_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
