// What a signal that ends the program must not leave behind.
#pragma once

namespace oro {

// From now on every signal that ends a program takes unfinished files with names along before it does, but
// for SIGKILL, which nothing can catch, and faults of the program's own. Ignored ones stay ignored (nohup). A
// pipe whose reader has gone is a write that fails, and is told as such. To be called before any thread is
// started.
void clean_up_when_interrupted();

// Where standard output was a pipe whose reader has gone (`orograph info | head`), the program ends as other
// programs do then: by SIGPIPE, without a word. Else returns. To be called by the thread that wrote.
void end_if_reader_has_gone();

}  // namespace oro
