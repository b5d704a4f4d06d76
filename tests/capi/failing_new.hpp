// The program's operator new, which is also the library's: behind every std:: container and make_unique in it.
#pragma once

namespace tetlod_test {

/// The operator new after `count` others in this thread fails, once; negative: none.
void fail_new_after(long count);
/// Whether it did, since fail_new_after was called with a count.
bool new_failed();

}  // namespace tetlod_test
