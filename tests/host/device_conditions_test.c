// The expressions of #if, with the macros that options define.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "device/conditions.h"

static const char OPTIONS[] = "-w -DON=1 -DOFF=0 -D PLAIN -DHEX=0x10 -DOFFER=1 -DTYPE=float -DTWICE=1 "
                              "-DTWICE=0 -Dlower=1 -DEMPTY= -DTEN=10u";

static void expect(const char *text, i32 value)
{
    const i32 found = condition_value(text, strlen(text), OPTIONS);
    if (found != value)
        fail_msg("'%s' is %d, not %d", text, found, value);
}

static void reads_names_and_integers(void **state)
{
    (void)state;
    expect("ON", 1);
    expect("OFF", 0);
    expect("OFFER", 1);
    expect("O", 0);
    expect("ONE", 0);
    expect("PLAIN", 1);
    expect("HEX", 1);
    expect("lower", 1);
    expect("TWICE", 0);
    expect("w", 0);
    expect("1", 1);
    expect("0", 0);
    expect("00", 0);
    expect("0x10UL", 1);
    expect(" ON // and so on", 1);
    expect("/* not */ ON /* here */", 1);
    expect("OFF \\\n || ON", 1);
}

static void joins_them(void **state)
{
    (void)state;
    expect("ON && OFF", 0);
    expect("ON && OFFER", 1);
    expect("OFF || ON", 1);
    expect("OFF||UNKNOWN", 0);
    expect("!OFF", 1);
    expect("!!ON", 1);
    expect("! ON", 0);
    expect("ON || ON && OFF", 1); // && binds first
    expect("(ON || ON) && OFF", 0);
    expect("!(OFF || UNKNOWN) && (ON)", 1);
    expect("!OFF && !ON", 0);
    expect("!ON || ON", 1);
    expect("defined(ON) && defined OFF && !defined UNKNOWN", 1);
    expect("defined UNKNOWN || defined ( PLAIN )", 1);
}

static void refuses_all_else(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "", "  ", "ON OFF", "ON &&", "|| ON", "(ON", "ON)", "()", "!", "ON & ON", "ON == 1", "HEX > 3", "-1",
        "1.5", "08", "1x", "TYPE", "EMPTY", "TEN", "defined", "defined()", "defined(ON", "ON ? 1 : 0",
        "\"ON\"", "ON &&& ON", "12345678901234567890123456",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        expect(texts[i], -1);
    char deep[1000];
    memset(deep, '(', sizeof deep);
    assert_int_equal(condition_value(deep, sizeof deep, ""), -1);
}

static void reads_no_further_than_told(void **state)
{
    (void)state;
    assert_int_equal(condition_value("OFFER", 3, OPTIONS), 0);
    assert_int_equal(condition_value("OFF || ON", 4, OPTIONS), 0);
    assert_int_equal(condition_value("ON /*", 5, OPTIONS), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_names_and_integers),
        cmocka_unit_test(joins_them),
        cmocka_unit_test(refuses_all_else),
        cmocka_unit_test(reads_no_further_than_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
