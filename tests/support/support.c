// SPDX-License-Identifier: GPL-3.0-or-later
// Comparing numbers, temporary files and commands for tests.
#include "support/support.h"

#include <dirent.h>
#include <fcntl.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/text.h"

struct arena *support_arena;
static struct arena *texts;
static char *folder;
static pid_t owner;  // of the folder: a forked child must not remove it

// Fails unless |got - want| <= limit, which is false for every NaN.
static void within(double got, double want, double limit, const char *how, double tolerance,
                   const char *file, int line) {
    if (got == want || (isfinite(want) && fabs(got - want) <= limit)) {
        return;
    }
    print_error("got  %.17g\nwant %.17g\nthey differ by %.3g; allowed is %s %g\n", got, want,
                fabs(got - want), how, tolerance);
    _fail(file, line);
}

void support_close(double got, double want, double rtol, const char *file, int line) {
    within(got, want, rtol * fabs(want), "a relative", rtol, file, line);
}

void support_near(double got, double want, double atol, const char *file, int line) {
    within(got, want, atol, "an absolute", atol, file, line);
}

// Removes the tree at `path`; what cannot be removed stays.
static void remove_tree(const char *path) {
    DIR *directory = opendir(path);
    if (!directory) {
        return;
    }
    for (const struct dirent *entry; (entry = readdir(directory));) {
        const char *name = entry->d_name;
        if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0) {
            continue;
        }
        struct stat info;
        if (fstatat(dirfd(directory), name, &info, AT_SYMLINK_NOFOLLOW) == 0 &&
            S_ISDIR(info.st_mode)) {
            char inner[4096];
            int n = snprintf(inner, sizeof inner, "%s/%s", path, name);
            if (n > 0 && (size_t)n < sizeof inner) {
                remove_tree(inner);
            }
        } else {
            unlinkat(dirfd(directory), name, 0);
        }
    }
    closedir(directory);
    rmdir(path);
}

static void clean_up(void) {
    if (folder && owner == getpid()) {
        remove_tree(folder);
    }
    arena_free(texts);
}

static struct arena *kept(void) {
    if (!texts) {
        texts = arena_create();
        if (!texts || atexit(clean_up) != 0) {
            fail_msg("out of memory");
        }
    }
    return texts;
}

const char *support_temporary(void) {
    if (!folder) {
        const char *top = getenv("TMPDIR");
        char *path = arena_format(kept(), "%s/jostle-XXXXXX", top && *top ? top : "/tmp");
        if (!path || !mkdtemp(path)) {
            fail_msg("cannot make a temporary folder");
        }
        owner = getpid();
        folder = path;
    }
    return folder;
}

const char *support_path(const char *name) {
    const char *top = support_temporary();
    char *path = arena_format(kept(), "%s/%s", top, name);
    if (!path) {
        fail_msg("out of memory");
    }
    return path;
}

int support_arena_open(void **state) {
    (void)state;
    support_arena = arena_create();
    return support_arena ? 0 : -1;
}

int support_arena_close(void **state) {
    (void)state;
    arena_free(support_arena);
    return 0;
}

void support_write_bytes(const char *path, const char *bytes, size_t n) {
    FILE *f = fopen(path, "wb");
    if (!f) {
        fail_msg("cannot write %s", path);
    }
    bool written = fwrite(bytes, 1, n, f) == n;
    if (fclose(f) != 0 || !written) {
        fail_msg("cannot write %s", path);
    }
}

const char *support_write(const char *name, const char *text) {
    const char *path = support_path(name);
    support_write_bytes(path, text, strlen(text));
    return path;
}

const char *support_read(const char *path, size_t *size) {
    FILE *f = fopen(path, "rb");
    struct stat info = {0};
    if (!f || fstat(fileno(f), &info) != 0) {
        fail_msg("cannot read %s", path);
    }
    size_t n = (size_t)info.st_size;
    char *text = arena_alloc(kept(), n + 1, 1);
    if (!text || fread(text, 1, n, f) != n) {
        fail_msg("cannot read %s", path);
    }
    fclose(f);
    if (size) {
        *size = n;
    }
    return text;
}

// In the child: joins `stream` to the file at `path`.
static void redirect(int stream, const char *path, int flags) {
    int file = open(path, flags, 0600);
    if (file < 0 || dup2(file, stream) < 0) {
        _exit(126);
    }
    close(file);
}

static int run(const char *line, const char *out, const char *err) {
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
        redirect(STDOUT_FILENO, out, O_WRONLY | O_CREAT | O_TRUNC);
        redirect(STDERR_FILENO, err, O_WRONLY | O_CREAT | O_TRUNC);
        execl("/bin/sh", "sh", "-c", line, (char *)NULL);
        _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) {
        fail_msg("cannot run %s", line);
    }
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

struct support_result support_run(const char *format, ...) {
    char line[8192];
    va_list list;
    va_start(list, format);
    int n = vsnprintf(line, sizeof line, format, list);
    va_end(list);
    if (n < 0 || (size_t)n >= sizeof line) {
        fail_msg("the command is too long");
    }
    setenv("JOSTLE", "build/jostle", 0);
    const char *out = support_path("support-out");
    const char *err = support_path("support-err");
    int status = run(line, out, err);
    return (struct support_result){
        .status = status,
        .out = support_read(out, NULL),
        .err = support_read(err, NULL),
    };
}

bool support_is_utf8(const char *text, size_t n, size_t *at) {
    for (size_t i = 0; i < n;) {
        size_t size = text_character(text + i, n - i);
        if (size == 0) {
            *at = i;
            return false;
        }
        i += size;
    }
    return true;
}
