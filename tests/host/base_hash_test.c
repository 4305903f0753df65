// XXH64 against the values of its specification's reference implementation, and however the bytes come.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/hash.h"

static u64 hash_of(const void *bytes, size_t length)
{
    Hash hash = hash_start();
    hash_add(&hash, bytes, length);
    return hash_value(&hash);
}

static void known_values(void **state)
{
    (void)state;
    assert_true(hash_of("", 0) == 0xEF46DB3751D8E999u);
    assert_true(hash_of("a", 1) == 0xD24EC4F1A98C6E5Bu);
    assert_true(hash_of("abc", 3) == 0x44BC2CF5AD770999u);
    const char long_text[] = "Call me Ishmael. Some years ago--never mind how long precisely-";
    assert_true(hash_of(long_text, strlen(long_text)) == 0x02A2E85470D6FD96u);
}

static void pieces(void **state)
{
    (void)state;
    u8 bytes[257];
    for (u32 i = 0; i < sizeof bytes; i++)
        bytes[i] = (u8)(i * 37 + 11);
    for (size_t piece = 1; piece <= sizeof bytes; piece++) {
        Hash hash = hash_start();
        for (size_t done = 0; done < sizeof bytes; done += piece) {
            const size_t left = sizeof bytes - done;
            hash_add(&hash, bytes + done, left < piece ? left : piece);
        }
        assert_true(hash_value(&hash) == hash_of(bytes, sizeof bytes));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(known_values), cmocka_unit_test(pieces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
