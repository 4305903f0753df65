#include <string.h>

#include "assets/obj_chunk.h"

enum { QUOTED_BYTES_MAX = 60 };

// What the statements have in common.
typedef struct Statement {
    ObjText *text;
    ObjBuilder *builder;
    ObjWord keyword;
    const ObjCounts *before, *total; // NULL: indices are not checked
} Statement;

static int quoted(const ObjWord *word)
{
    return word->length < QUOTED_BYTES_MAX ? (int)word->length : QUOTED_BYTES_MAX;
}

// Reads at least min and at most max numbers, all of the statement.
static void read_numbers(const Statement *statement, f64 *values, int min, int max)
{
    ObjText *text = statement->text;
    const ObjWord *keyword = &statement->keyword;
    ObjWord word;
    int count = 0;
    while (obj_text_word(text, &word)) {
        if (count == max) {
            obj_text_report(text, SEVERITY_ERROR, &word, "unexpected '%.*s' after the %d numbers of %.*s",
                            quoted(&word), word.text, max, quoted(keyword), keyword->text);
            return;
        }
        if (!obj_text_number(text, &word, &values[count])) {
            values[count] = 0;
            return;
        }
        ++count;
    }
    if (count < min) {
        obj_text_report(text, SEVERITY_ERROR, &word, "%.*s needs %d number%s, here %s %d", quoted(keyword),
                        keyword->text, min, min == 1 ? "" : "s", count == 1 ? "is" : "are", count);
    }
}

// What is wrong below takes its place all the same, so that indices to others stay right.

// x y z [w] [r g b [a]]
static void read_position(const Statement *statement)
{
    f64 v[8] = { 0 };
    read_numbers(statement, v, 3, 8);
    obj_add_position(statement->builder, (Vec3){ v[0], v[1], v[2] });
}

static void read_normal(const Statement *statement)
{
    f64 v[3] = { 0 };
    read_numbers(statement, v, 3, 3);
    obj_add_normal(statement->builder, (Vec3){ v[0], v[1], v[2] });
}

// u [v [w]]
static void read_uv(const Statement *statement)
{
    f64 v[3] = { 0 };
    read_numbers(statement, v, 1, 3);
    obj_add_uv(statement->builder, v[0], v[1]);
}

// ---- faces ----------------------------------------------------------------------------------

// One of the kinds of things that a corner has an index of.
typedef struct Kind {
    const char *name;
    size_t in_chunk; // elements
    u64 before, total;
} Kind;

// Whether the index, not 0, refers to something; reports it where not.
static bool check_index(const Statement *statement, const ObjWord *word, i64 index, const Kind *kind)
{
    const u64 defined = kind->before + kind->in_chunk;
    if (index > 0 && (u64)index > kind->total) {
        obj_text_report(statement->text, SEVERITY_ERROR, word, "there is no %s %.*s: the file has %llu",
                        kind->name, quoted(word), word->text, (unsigned long long)kind->total);
        return false;
    }
    if (index < 0 && (u64)-index > defined) {
        obj_text_report(statement->text, SEVERITY_ERROR, word,
                        "there is no %s %.*s: up to here the file has %llu", kind->name, quoted(word),
                        word->text, (unsigned long long)defined);
        return false;
    }
    return true;
}

// Reads "[+-]digits" from *p on, which moves behind it; false where there are none. Huge ones become about
// 10^18.
static bool read_integer(const char **p, const char *end, i64 *value)
{
    const char *sign = *p;
    const bool negative = sign < end && *sign == '-';
    const char *digits = sign + (sign < end && (negative || *sign == '+')), *q = digits;
    i64 magnitude = 0;
    for (; q < end && *q >= '0' && *q <= '9'; ++q) {
        if (magnitude < INT64_C(100000000000000000))
            magnitude = magnitude * 10 + (*q - '0');
    }
    if (q == digits)
        return false;
    *value = negative ? -magnitude : magnitude;
    *p = q;
    return true;
}

// Reads v, v/vt, v//vn or v/vt/vn; parts but the first may be missing.
static bool read_corner(const Statement *statement, const ObjWord *word, ObjCorner *corner)
{
    const ObjChunk *chunk = &statement->builder->chunk;
    static const ObjCounts none = { 0 };
    const ObjCounts *before = statement->before ? statement->before : &none;
    const ObjCounts *total = statement->total ? statement->total : &none;
    const Kind kinds[3] = {
        { "vertex", chunk->position_count, before->positions, total->positions },
        { "texture coordinate", chunk->uv_count, before->uvs, total->uvs },
        { "normal", chunk->normal_count, before->normals, total->normals },
    };
    i32 codes[3] = { 0 };
    const char *p = word->text, *end = word->text + word->length;
    for (int i = 0; i < 3; ++i) {
        const ObjWord rest = { p, (size_t)(end - p), word->line_text, word->line };
        i64 index;
        const bool present = read_integer(&p, end, &index);
        const bool ends = p == end;
        if ((!present && (i == 0 || (!ends && *p != '/'))) || (!ends && (*p != '/' || i == 2))) {
            obj_text_report(statement->text, SEVERITY_ERROR, word,
                            "'%.*s' is no corner of a face: 1, 1/2, 1//3 or 1/2/3", quoted(word), word->text);
            return false;
        }
        const ObjWord part = { rest.text, (size_t)(p - rest.text), word->line_text, word->line };
        if (present && index == 0) {
            obj_text_report(statement->text, SEVERITY_ERROR, &part, "there is no %s 0: indices begin at 1",
                            kinds[i].name);
            return false;
        }
        if (present && statement->total && !check_index(statement, &part, index, &kinds[i]))
            return false;
        if (present && !obj_encode(index, kinds[i].in_chunk, &codes[i])) {
            obj_text_report(statement->text, SEVERITY_ERROR, &part, "there is no %s %.*s", kinds[i].name,
                            quoted(&part), part.text);
            return false;
        }
        if (ends)
            break;
        ++p;
    }
    *corner = (ObjCorner){ .position = codes[0], .uv = codes[1], .normal = codes[2] };
    return true;
}

// Reads the corners of a polygon and adds its fan.
static void read_face(const Statement *statement)
{
    ObjBuilder *builder = statement->builder;
    const size_t face_count = builder->chunk.face_count;
    ObjCorner first = { 0 }, last = { 0 }, corner;
    ObjWord word;
    size_t count = 0;
    while (obj_text_word(statement->text, &word)) {
        if (!read_corner(statement, &word, &corner)) {
            builder->chunk.face_count = face_count;
            return;
        }
        if (count == 0)
            first = corner;
        else if (count > 1)
            obj_add_face(builder, &first, &last, &corner);
        last = corner;
        ++count;
    }
    if (count < 3)
        obj_text_report(statement->text, SEVERITY_ERROR, &word, "a face needs 3 corners, here %s %d",
                        count == 1 ? "is" : "are", (int)count);
}

// ---- all statements -------------------------------------------------------------------------

// Whether the keyword is one of the format that has no say in the triangles.
static bool is_ignored(const ObjWord *keyword)
{
    static const char *const ignored[] = {
        "o", "g", "s", "l", "p", "mg", "usemap", "maplib", "vp", "cstype", "deg", "bmat", "step", "curv",
        "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "bevel", "c_interp", "d_interp",
        "lod", "shadow_obj", "trace_obj", "ctech", "stech", "bsp", "bzp", "cdc", "cdp", "res"
    };
    for (size_t i = 0; i < sizeof ignored / sizeof *ignored; ++i) {
        if (obj_word_is(keyword, ignored[i]))
            return true;
    }
    return false;
}

void obj_statement(ObjText *text, ObjBuilder *builder, ObjWords *unknown, const ObjCounts *before,
                   const ObjCounts *total)
{
    Statement statement = { .text = text, .builder = builder, .before = before, .total = total };
    const ObjWord *keyword = &statement.keyword;
    if (obj_text_word(text, &statement.keyword)) {
        if (obj_word_is(keyword, "v"))
            read_position(&statement);
        else if (obj_word_is(keyword, "vn"))
            read_normal(&statement);
        else if (obj_word_is(keyword, "vt"))
            read_uv(&statement);
        else if (obj_word_is(keyword, "f") || obj_word_is(keyword, "fo"))
            read_face(&statement);
        else if (obj_word_is(keyword, "usemtl"))
            obj_add_mark(builder, OBJ_USE_MATERIAL, text);
        else if (obj_word_is(keyword, "mtllib"))
            obj_add_mark(builder, OBJ_USE_LIBRARY, text);
        else if (!is_ignored(keyword) && obj_words_add(unknown, keyword->text, keyword->length))
            obj_text_report(text, SEVERITY_WARNING, keyword, "'%.*s' is not known; it is skipped",
                            quoted(keyword), keyword->text);
    }
    obj_text_next_statement(text);
}
