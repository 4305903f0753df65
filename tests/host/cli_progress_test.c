// The line of the progress bar, and that it is silent where it should be.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cli/progress.h"

static void says_share_rate_and_time(void **state)
{
    (void)state;
    char line[128];
    progress_line(line, sizeof line, 60, 0.25, 24600000, 2.0);
    assert_string_equal(line, "[======>                    ]  25 %  12.3 Mrays/s  0:06 left");
    assert_int_equal(strlen(line), 60);
    progress_line(line, sizeof line, 79, 1.0, 2000000, 1.0);
    assert_string_equal(line, "[========================================] 100 %  2.0 Mrays/s  0:00 left");
    progress_line(line, sizeof line, 44, 0.5, 1000000, 4000.0);
    assert_string_equal(line, "[====>    ]  50 %  0.0 Mrays/s  1:06:40 left");
}

static void leaves_out_what_is_unknown_or_has_no_room(void **state)
{
    (void)state;
    char line[128];
    progress_line(line, sizeof line, 40, 0.0, 0, 0.0);
    assert_string_equal(line, "[>                  ]   0 %  0.0 Mrays/s");
    progress_line(line, sizeof line, 30, 0.999, 5000000, 1.0);
    assert_string_equal(line, " 99 %  5.0 Mrays/s  0:00 left");
    progress_line(line, sizeof line, 10, 0.5, 5000000, 1.0);
    assert_string_equal(line, " 50 %  5.0");
    progress_line(line, 4, 80, 0.5, 5000000, 1.0);
    assert_string_equal(line, " 50");
    progress_line(line, sizeof line, 0, 0.5, 5000000, 1.0);
    assert_string_equal(line, "");
    progress_line(line, sizeof line, 40, 7.0, 0, 1.0); // beyond the end is the end
    assert_non_null(strstr(line, "100 %"));
}

static void is_silent_where_there_is_no_terminal(void **state)
{
    (void)state;
    FILE *file = tmpfile();
    assert_non_null(file);
    Progress progress = progress_start(file, false);
    progress.start -= 10; // as if it ran for a while
    progress_update(&progress, 0.5, 1000);
    progress_end(&progress);
    assert_int_equal(ftell(file), 0);
    fclose(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(says_share_rate_and_time),
        cmocka_unit_test(leaves_out_what_is_unknown_or_has_no_room),
        cmocka_unit_test(is_silent_where_there_is_no_terminal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
