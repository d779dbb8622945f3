// TetGen 1.5's library reports a failure by freeing its memory and throwing an int, and frees the same memory again while the exception
// unwinds: a crash in most cases, with the code lost. The function that does so is an exported inline one, so this definition in the
// program takes its place (terminatetetgen must not be declared inline here: hence no tetgen.h) and ends the worker with the code on
// record.
class tetgenmesh;

namespace smopt::metrics::worker {
[[noreturn]] void finish_with_code(int code);
}

void terminatetetgen(tetgenmesh* mesh, int code);

void terminatetetgen(tetgenmesh* /*mesh*/, int code) {
  smopt::metrics::worker::finish_with_code(code);
}
