// Csv: rows of the report as tables for other programs.
#ifndef CLRT_REPORT_CSV_H
#define CLRT_REPORT_CSV_H

#include <jansson.h>

#include "base/error.h"

// One line an object of the array `rows`, which all have the keys of the first: a column a value, named by
// its path of keys. Arrays of texts are joined by spaces, other arrays left out, null is empty. False with
// ERROR_IO.
bool csv_write_rows(const json_t *rows, const char *path, Error *error);

// One line a point of each row's convergence, with the row's scene, device and mode. False with ERROR_IO.
bool csv_write_convergence(const json_t *rows, const char *path, Error *error);

typedef struct Peer {
    char name[64];
    double seconds, rmse; // above 0
} Peer;

enum { PEERS_MAX = 64 };

// Reads lines "name,seconds,rmse"; empty ones, those that begin with # and a first one of that very text are
// skipped. False with ERROR_IO, which names the line.
bool csv_read_peers(const char *path, Peer peers[PEERS_MAX], size_t *count, Error *error);

#endif
