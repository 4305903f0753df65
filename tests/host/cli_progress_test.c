// The line of the progress bar, that a terminal gets it, and that it is silent where it should be.
#define _XOPEN_SOURCE 700 // posix_openpt

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

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

// What stands in the terminal's other end, at most size - 1 characters.
static void read_terminal(int descriptor, char *text, size_t size)
{
    const ssize_t length = read(descriptor, text, size - 1);
    text[length > 0 ? length : 0] = '\0';
}

static void draws_on_a_terminal(void **state)
{
    (void)state;
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0)
        skip();
    const struct winsize size = {.ws_row = 24, .ws_col = 51};
    assert_int_equal(ioctl(master, TIOCSWINSZ, &size), 0);
    assert_int_equal(fcntl(master, F_SETFL, O_NONBLOCK), 0);
    FILE *terminal = fopen(ptsname(master), "w");
    assert_non_null(terminal);
    setenv("TERM", "xterm", 1);
    char text[256];

    Progress progress = progress_start(terminal, false);
    progress_update(&progress, 0.5, 1000); // in the first half second there is nothing to see
    read_terminal(master, text, sizeof text);
    assert_string_equal(text, "");
    progress.start -= 10; // as if it ran for a while
    progress_update(&progress, 0.5, 1000);
    read_terminal(master, text, sizeof text);
    assert_string_equal(text, "\r[=========>        ]  50 %  0.0 Mrays/s  0:10 left\033[K");
    progress_update(&progress, 0.6, 1000); // too soon for another one
    read_terminal(master, text, sizeof text);
    assert_string_equal(text, "");
    progress_end(&progress);
    read_terminal(master, text, sizeof text);
    assert_string_equal(text, "\r\033[K");
    progress_end(&progress); // there is nothing left to take away
    read_terminal(master, text, sizeof text);
    assert_string_equal(text, "");

    Progress quiet = progress_start(terminal, true);
    assert_null(quiet.stream);
    setenv("TERM", "dumb", 1);
    Progress dumb = progress_start(terminal, false);
    assert_null(dumb.stream);
    fclose(terminal);
    close(master);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(says_share_rate_and_time),
        cmocka_unit_test(leaves_out_what_is_unknown_or_has_no_room),
        cmocka_unit_test(is_silent_where_there_is_no_terminal),
        cmocka_unit_test(draws_on_a_terminal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
