#include "assets/obj.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "assets/obj_internal.h"
#include "assets/obj_join.h"

enum {
    PIECE_BYTES = 256 << 10, // text and arrays of a piece stay in a core's cache
    FAILURE_CHANGED = -1     // of a piece: the file has become shorter
};

// A file that is read; all threads share the descriptor.
typedef struct Reader {
    const char *path;
    int descriptor;
    u64 size;
    ObjPiece *pieces;
    size_t piece_count;
} Reader;

// What a thread keeps from piece to piece.
typedef struct Worker {
    char *text;
    size_t room;
    ObjBuilder builder;
} Worker;

static void worker_destroy(Worker *worker)
{
    free(worker->text);
    obj_builder_destroy(&worker->builder);
}

// ---- pieces ---------------------------------------------------------------------------------

// Reads length bytes at offset. Returns 0, an errno value or FAILURE_CHANGED.
static int read_range(int descriptor, u64 offset, char *to, size_t length)
{
    while (length > 0) {
        const ssize_t got = pread(descriptor, to, length, (off_t)offset);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return got < 0 ? errno : FAILURE_CHANGED;
        to += got;
        offset += (u64)got;
        length -= (size_t)got;
    }
    return 0;
}

// Finds the first statement that begins at or after `from`, which is not 0, and surely begins there, whatever
// the text before says: behind the end of a line that no backslash precedes. The file's size where there is
// none.
static int find_statement(const Reader *reader, u64 from, u64 *start)
{
    // An end of a line is judged by two characters before it and one behind.
    enum { BEFORE = 3, WINDOW = 4096 };
    char window[WINDOW];
    u64 offset = from > BEFORE ? from - BEFORE : 0;
    while (offset < reader->size) {
        const u64 left = reader->size - offset;
        const size_t length = left < WINDOW ? (size_t)left : WINDOW;
        const int failure = read_range(reader->descriptor, offset, window, length);
        if (failure != 0)
            return failure;
        for (size_t i = offset == 0 ? (size_t)from - 1 : BEFORE - 1; i + 1 < length; ++i) {
            const bool feed = window[i] == '\n', alone = window[i] == '\r' && window[i + 1] != '\n';
            const size_t back = feed && i > 0 && window[i - 1] == '\r' ? 2 : 1;
            if ((feed || alone) && (i < back || window[i - back] != '\\')) {
                *start = offset + i + 1;
                return 0;
            }
        }
        if (length < WINDOW)
            break;
        offset += WINDOW - BEFORE;
    }
    *start = reader->size;
    return 0;
}

static bool failed(Error *error, int failure)
{
    if (failure == ENOMEM)
        return error_set(error, ERROR_MEMORY, "out of memory");
    return error_set(error, ERROR_IO, "%s",
                     failure == FAILURE_CHANGED ? "it changed while it was read" : strerror(failure));
}

// Divides the file. Statement by statement, not line by line, so that no piece needs the one before.
static bool find_pieces(Reader *reader, size_t piece_bytes, Error *error)
{
    const u64 count_max = reader->size / piece_bytes + 1;
    if (count_max > SIZE_MAX / sizeof *reader->pieces)
        return failed(error, ENOMEM);
    reader->pieces = calloc((size_t)count_max, sizeof *reader->pieces);
    if (!reader->pieces)
        return failed(error, ENOMEM);
    u64 begin = 0;
    while (begin < reader->size) {
        u64 end = reader->size;
        const u64 wanted = (begin / piece_bytes + 1) * piece_bytes;
        const int failure = wanted < reader->size ? find_statement(reader, wanted, &end) : 0;
        if (failure != 0)
            return failed(error, failure);
        if (end - begin > SIZE_MAX / 2)
            return failed(error, ENOMEM);
        ObjPiece *piece = &reader->pieces[reader->piece_count++];
        piece->offset = begin;
        piece->length = (size_t)(end - begin);
        begin = end;
    }
    return true;
}

// Reads the text of the piece; *text stands at its first statement.
static int load_text(const Reader *reader, const ObjPiece *piece, Worker *worker, ObjText *text)
{
    const size_t wanted = piece->length + OBJ_PADDING;
    if (wanted > worker->room) {
        free(worker->text);
        worker->text = malloc(wanted);
        worker->room = worker->text ? wanted : 0;
        if (!worker->text)
            return ENOMEM;
    }
    const int failure = read_range(reader->descriptor, piece->offset, worker->text, piece->length);
    memset(worker->text + piece->length, 0, OBJ_PADDING);
    const size_t mark = piece->offset == 0 && strncmp(worker->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    *text = obj_text_begin(worker->text + mark, piece->length - mark);
    return failure;
}

static void parse_piece(const Reader *reader, ObjPiece *piece, Worker *worker)
{
    ObjText text;
    piece->failure = load_text(reader, piece, worker, &text);
    if (piece->failure != 0)
        return;
    obj_parse_chunk(&text, &worker->builder, &piece->unknown);
    piece->lines = text.line - 1;
    piece->faulty = text.errors;
    if (worker->builder.no_memory || !obj_pack(&worker->builder, &piece->chunk))
        piece->failure = ENOMEM;
}

// ---- messages -------------------------------------------------------------------------------

// Whether the piece has a word that is not in known, to which it is added.
static bool has_news(const ObjPiece *piece, ObjWords *known)
{
    bool news = false;
    for (u32 i = 0; i < piece->unknown.count; ++i)
        news |= obj_words_add(known, piece->unknown.words[i], OBJ_WORD_BYTES);
    return news;
}

// Reads the pieces of which something is to be said once more, now statement by statement and knowing what
// stands in the others, and says it.
static bool report(const Reader *reader, const ObjCounts *total, Diagnostics *diagnostics, Error *error)
{
    ObjWords known = { 0 }, reported = { 0 };
    Worker worker = { 0 };
    bool faulty = false, errors = false;
    int failure = 0;
    for (size_t i = 0; i < reader->piece_count; ++i) {
        const ObjPiece *piece = &reader->pieces[i];
        if (failure != 0 || (errors && diagnostics_full(diagnostics)))
            break;
        if (!has_news(piece, &known) && !piece->faulty)
            continue;
        ObjText text;
        failure = load_text(reader, piece, &worker, &text);
        if (failure != 0)
            break;
        text.line += piece->lines_before;
        text.file_name = reader->path;
        text.diagnostics = diagnostics;
        obj_builder_clear(&worker.builder);
        while (text.cursor < text.end && !worker.builder.no_memory)
            obj_statement(&text, &worker.builder, &reported, &piece->before, total);
        if (worker.builder.no_memory)
            failure = ENOMEM;
        faulty |= piece->faulty;
        errors |= text.errors;
    }
    worker_destroy(&worker);
    if (failure == 0 && faulty && !errors)
        failure = FAILURE_CHANGED;
    return failure == 0 || failed(error, failure);
}

// ---------------------------------------------------------------------------------------------

static bool parse_pieces(Reader *reader, Error *error)
{
    const locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c_locale == (locale_t)0)
        return failed(error, ENOMEM);
    const size_t count = reader->piece_count;
#pragma omp parallel if (count > 1)
    {
        const locale_t before = uselocale(c_locale);
        Worker worker = { 0 };
#pragma omp for schedule(dynamic)
        for (size_t i = 0; i < count; ++i)
            parse_piece(reader, &reader->pieces[i], &worker);
        worker_destroy(&worker);
        uselocale(before);
    }
    freelocale(c_locale);
    for (size_t i = 0; i < count; ++i) {
        if (reader->pieces[i].failure != 0)
            return failed(error, reader->pieces[i].failure);
    }
    return true;
}

static bool read_pieces(Reader *reader, Diagnostics *diagnostics, ObjFile *obj, Error *error)
{
    if (!parse_pieces(reader, error))
        return false;
    const ObjCounts total = obj_sum(reader->pieces, reader->piece_count);
    if (total.positions > OBJ_COUNT_MAX || total.normals > OBJ_COUNT_MAX || total.uvs > OBJ_COUNT_MAX ||
        total.faces > OBJ_COUNT_MAX) {
        diagnostics_add(diagnostics, SEVERITY_ERROR, reader->path, 0, 0, 0, NULL,
                        "more than %d vertices, normals, texture coordinates or triangles", OBJ_COUNT_MAX);
        return true;
    }
    return obj_join(reader->pieces, reader->piece_count, &total, reader->path, obj, error) &&
           report(reader, &total, diagnostics, error);
}

static bool open_file(const char *path, Reader *reader, Error *error)
{
    // A pipe without a writer would hold up a blocking open.
    reader->descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status;
    if (reader->descriptor < 0 || fstat(reader->descriptor, &status) != 0)
        return failed(error, errno);
    if (S_ISDIR(status.st_mode))
        return failed(error, EISDIR);
    if (!S_ISREG(status.st_mode))
        return error_set(error, ERROR_IO, "not a regular file");
    reader->size = (u64)status.st_size;
    return true;
}

bool obj_read_in_pieces(const char *path, size_t piece_bytes, Diagnostics *diagnostics, ObjFile *obj,
                        Error *error)
{
    *obj = (ObjFile){ .arena = arena_create() };
    if (!obj->arena)
        return failed(error, ENOMEM);
    const u32 errors = diagnostics_error_count(diagnostics);
    Reader reader = { .path = path, .descriptor = -1 };
    const bool done = open_file(path, &reader, error) && find_pieces(&reader, piece_bytes, error) &&
                      read_pieces(&reader, diagnostics, obj, error);
    for (size_t i = 0; i < reader.piece_count; ++i)
        free(reader.pieces[i].chunk.positions);
    free(reader.pieces);
    if (reader.descriptor >= 0)
        close(reader.descriptor);
    if (!done || diagnostics_error_count(diagnostics) > errors)
        obj_destroy(obj);
    return done;
}

bool obj_read(const char *path, Diagnostics *diagnostics, ObjFile *obj, Error *error)
{
    return obj_read_in_pieces(path, PIECE_BYTES, diagnostics, obj, error);
}

void obj_destroy(ObjFile *obj)
{
    mesh_destroy(&obj->mesh);
    arena_destroy(obj->arena);
    *obj = (ObjFile){ 0 };
}
