#include "device/conditions.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

typedef struct Expression {
    const char *at, *end;
    const char *options;
    u32 nesting;
    bool broken;
} Expression;

enum { NESTING_MAX = 64 };

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

// What stands behind the last -DNAME= of the options, "1" for -DNAME alone, NULL where there is neither.
static const char *find_macro(const char *options, const char *name, size_t length)
{
    const char *found = NULL;
    for (const char *at = options; (at = strstr(at, "-D"));) {
        const bool begins = at == options || isspace((unsigned char)at[-1]);
        at += 2;
        while (isspace((unsigned char)*at))
            at++;
        if (begins && strncmp(at, name, length) == 0 && !is_word(at[length]))
            found = at[length] == '=' ? at + length + 1 : "1";
    }
    return found;
}

static bool value_of_name(Expression *e, const char *name, size_t length)
{
    const char *value = find_macro(e->options, name, length);
    if (!value)
        return false;
    char *end;
    const long number = strtol(value, &end, 0);
    if (isspace((unsigned char)*value) || end == value || (*end && !isspace((unsigned char)*end)))
        e->broken = true;
    return number != 0;
}

static void skip_blanks(Expression *e)
{
    while (e->at < e->end) {
        const bool more = e->end - e->at > 1;
        if (isspace((unsigned char)*e->at) || *e->at == '\\') { // a line that goes on
            e->at++;
        } else if (more && e->at[0] == '/' && e->at[1] == '/') {
            e->at = e->end;
        } else if (more && e->at[0] == '/' && e->at[1] == '*') {
            e->at += 2;
            while (e->end - e->at > 1 && !(e->at[0] == '*' && e->at[1] == '/'))
                e->at++;
            e->at = e->end - e->at > 1 ? e->at + 2 : e->end;
        } else {
            return;
        }
    }
}

static bool accept(Expression *e, const char *sign)
{
    const size_t length = strlen(sign);
    skip_blanks(e);
    if ((size_t)(e->end - e->at) < length || memcmp(e->at, sign, length) != 0)
        return false;
    e->at += length;
    return true;
}

static size_t word(Expression *e, const char **from)
{
    skip_blanks(e);
    *from = e->at;
    while (e->at < e->end && is_word(*e->at))
        e->at++;
    return (size_t)(e->at - *from);
}

static bool is_defined(Expression *e)
{
    const bool bracket = accept(e, "(");
    const char *name;
    const size_t length = word(e, &name);
    if (length == 0 || (bracket && !accept(e, ")")))
        e->broken = true;
    return length > 0 && find_macro(e->options, name, length);
}

static bool integer(Expression *e, const char *digits, size_t length)
{
    char text[24] = "";
    if (length < sizeof text)
        memcpy(text, digits, length);
    char *end;
    const unsigned long value = strtoul(text, &end, 0);
    if (end == text || end[strspn(end, "uUlL")])
        e->broken = true;
    return value != 0;
}

static bool any_of(Expression *e);

static bool operand(Expression *e)
{
    bool negated = false;
    while (accept(e, "!"))
        negated = !negated;
    bool value = false;
    if (accept(e, "(")) {
        if (e->nesting++ < NESTING_MAX)
            value = any_of(e);
        else
            e->broken = true;
        if (!accept(e, ")"))
            e->broken = true;
    } else {
        const char *from;
        const size_t length = word(e, &from);
        if (length == 0)
            e->broken = true;
        else if (isdigit((unsigned char)*from))
            value = integer(e, from, length);
        else if (length == 7 && memcmp(from, "defined", 7) == 0)
            value = is_defined(e);
        else
            value = value_of_name(e, from, length);
    }
    return value != negated;
}

static bool all_of(Expression *e)
{
    bool value = operand(e);
    while (!e->broken && accept(e, "&&")) {
        const bool next = operand(e);
        value = value && next;
    }
    return value;
}

static bool any_of(Expression *e)
{
    bool value = all_of(e);
    while (!e->broken && accept(e, "||")) {
        const bool next = all_of(e);
        value = value || next;
    }
    return value;
}

i32 condition_value(const char *text, size_t length, const char *options)
{
    Expression e = {.at = text, .end = text + length, .options = options};
    const bool value = any_of(&e);
    skip_blanks(&e);
    return e.broken || e.at < e.end ? -1 : value;
}

static bool evaluate(Conditions *c, const Expression *line)
{
    const i32 value = condition_value(line->at, (size_t)(line->end - line->at), c->options);
    if (value < 0)
        c->broken = true;
    return value == 1;
}

static void open_condition(Conditions *c, bool holds)
{
    if (c->depth == CONDITIONS_MAX) {
        c->broken = true;
        return;
    }
    // In a part that is left out no branch holds.
    c->held[c->depth] = holds || !conditions_hold(c);
    c->holds[c->depth++] = holds;
}

// Goes on to another branch of the innermost `#if`, which holds where none before it did.
static void next_branch(Conditions *c, bool holds)
{
    const u32 i = c->depth - 1;
    c->holds[i] = holds && !c->held[i];
    c->held[i] = c->held[i] || holds;
}

void conditions_take(Conditions *c, const char *line, size_t length)
{
    Expression rest = {.at = line, .end = line + length, .options = c->options};
    const char *name;
    accept(&rest, "#");
    const size_t size = word(&rest, &name);
    char directive[8] = "";
    if (size < sizeof directive)
        memcpy(directive, name, size);
    const bool is_ifdef = strcmp(directive, "ifdef") == 0, is_else = strcmp(directive, "else") == 0;
    const bool ends = strcmp(directive, "endif") == 0;
    if (strcmp(directive, "if") == 0) {
        // What stands in a part that is left out need not be understood.
        open_condition(c, conditions_hold(c) && evaluate(c, &rest));
    } else if (is_ifdef || strcmp(directive, "ifndef") == 0) {
        const bool defined = is_defined(&rest);
        c->broken = c->broken || rest.broken;
        open_condition(c, defined == is_ifdef);
    } else if (ends || is_else || strcmp(directive, "elif") == 0) {
        if (c->depth == 0)
            c->broken = true;
        else if (ends)
            c->depth--;
        else
            next_branch(c, is_else || (!c->held[c->depth - 1] && evaluate(c, &rest)));
    }
}

bool conditions_hold(const Conditions *c)
{
    for (u32 i = 0; i < c->depth; i++)
        if (!c->holds[i])
            return false;
    return true;
}
