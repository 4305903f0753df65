// The file of devices that have given the known answers.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "selftest/trust.h"

static char folder[] = "/tmp/clrt-trust-XXXXXX";

static DeviceInfo device_called(const char *name)
{
    DeviceInfo info = {.driver = "1.0", .platform_name = "Platform"};
    snprintf(info.name, sizeof info.name, "%s", name);
    return info;
}

static u32 lines_of_file(void)
{
    char path[128];
    snprintf(path, sizeof path, "%s/clrt/devices", folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    u32 lines = 0;
    for (int c = getc(file); c != EOF; c = getc(file))
        lines += c == '\n';
    fclose(file);
    return lines;
}

static void devices_are_remembered(void **state)
{
    (void)state;
    const DeviceInfo one = device_called("one"), two = device_called("two");
    DeviceInfo newer = one, elsewhere = one;
    strcpy(newer.driver, "1.1");
    strcpy(elsewhere.platform_name, "Other");
    assert_false(trust_remembers(folder, &one));
    assert_true(trust_remember(folder, &one));
    assert_true(trust_remembers(folder, &one));
    assert_false(trust_remembers(folder, &two));
    assert_false(trust_remembers(folder, &newer));
    assert_false(trust_remembers(folder, &elsewhere));
    assert_true(trust_remember(folder, &newer));
    assert_true(trust_remembers(folder, &one) && trust_remembers(folder, &newer));
    assert_true(trust_remember(folder, &one)); // once again is still one line
    assert_int_equal(lines_of_file(), 2);
}

static void names_that_are_lines_are_none(void **state)
{
    (void)state;
    const DeviceInfo odd = device_called("two\nlines\r\n");
    assert_true(trust_remember(folder, &odd));
    assert_true(trust_remembers(folder, &odd));
    DeviceInfo longest = device_called("");
    memset(longest.name, 'n', sizeof longest.name - 1);
    memset(longest.platform_name, 'p', sizeof longest.platform_name - 1);
    memset(longest.driver, 'd', sizeof longest.driver - 1);
    assert_true(trust_remember(folder, &longest));
    assert_true(trust_remembers(folder, &longest));
    assert_true(trust_remembers(folder, &odd));
}

static void the_file_stays_short(void **state)
{
    (void)state;
    char name[32];
    for (u32 i = 0; i < 100; i++) {
        snprintf(name, sizeof name, "device %u", i);
        const DeviceInfo info = device_called(name);
        assert_true(trust_remember(folder, &info));
    }
    const DeviceInfo old = device_called("device 50"), late = device_called("device 80");
    assert_false(trust_remembers(folder, &old));
    assert_true(trust_remembers(folder, &late));
    assert_int_equal(lines_of_file(), 32);
}

static void what_is_no_line_is_left_out(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof path, "%s/clrt/devices", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (u32 i = 0; i < 5000; i++)
        putc('x', file);
    fputs("\nhalf a li", file);
    fclose(file);
    const DeviceInfo one = device_called("one");
    assert_false(trust_remembers(folder, &one));
    assert_true(trust_remember(folder, &one));
    assert_true(trust_remembers(folder, &one));
}

static void no_place_to_remember_is_no_failure(void **state)
{
    (void)state;
    const DeviceInfo one = device_called("one");
    assert_false(trust_remember("/nowhere/at all", &one));
    assert_false(trust_remembers("/nowhere/at all", &one));
    assert_false(trust_remember("/dev/null", &one));
    unsetenv("XDG_CACHE_HOME");
    unsetenv("HOME");
    assert_false(trust_remember(NULL, &one) || trust_remembers(NULL, &one));
    setenv("XDG_CACHE_HOME", "relative", 1); // not a path by the specification
    assert_false(trust_remember(NULL, &one));
    setenv("XDG_CACHE_HOME", folder, 1);
    assert_true(trust_remember(NULL, &one) && trust_remembers(NULL, &one) && trust_remembers(folder, &one));
    unsetenv("XDG_CACHE_HOME");
    char home[64], file[128];
    snprintf(home, sizeof home, "%s/home", folder);
    assert_int_equal(mkdir(home, 0700), 0);
    setenv("HOME", home, 1);
    assert_true(trust_remember(NULL, &one) && trust_remembers(NULL, &one));
    snprintf(file, sizeof file, "%s/.cache/clrt/devices", home);
    assert_int_equal(access(file, R_OK), 0);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(devices_are_remembered),
        cmocka_unit_test(names_that_are_lines_are_none),
        cmocka_unit_test(the_file_stays_short),
        cmocka_unit_test(what_is_no_line_is_left_out),
        cmocka_unit_test(no_place_to_remember_is_no_failure),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
