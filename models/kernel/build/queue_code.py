"""Threads that take rows from a queue and have an entry work on each, as LLVM's code, and their memory.

All threads share a row of 8-byte numbers: `models.kernel.cuda.QueueJob`, then what the entry is given.
Each thread has a work space, which begins with 64 numbers: the bytes used, the bytes there are, the time at
which it is closed, and in number k the last block of 2^k bytes that was given back. Where a block is asked
for and the space is full or closed, the entry ends as where memory is missing.
"""

ROWS_AT, ANSWERS_AT = 4, 13
"""Where the address of a row and that of its answers stand among what the entry is given."""
_MEMORY = """
declare i64 @llvm.ctlz.i64(i64, i1)
declare ptr @thread_space()
declare i64 @thread_clock()

define noalias ptr @malloc(i64 %size) noinline {
  %space = call ptr @thread_space()
  %closing = getelementptr i64, ptr %space, i64 2
  %closes = load i64, ptr %closing
  %now = call i64 @thread_clock()
  %closed = icmp ugt i64 %now, %closes
  br i1 %closed, label %none, label %open
open:
  %with = add i64 %size, 15
  %zeros = call i64 @llvm.ctlz.i64(i64 %with, i1 false)
  %k = sub i64 64, %zeros
  %head = getelementptr i64, ptr %space, i64 %k
  %kept = load ptr, ptr %head
  %fresh = icmp eq ptr %kept, null
  br i1 %fresh, label %cut, label %again
again:
  %before = load ptr, ptr %kept
  store ptr %before, ptr %head
  ret ptr %kept
cut:
  %used = load i64, ptr %space
  %whole = shl i64 1, %k
  %end = add i64 %used, %whole
  %size_at = getelementptr i64, ptr %space, i64 1
  %most = load i64, ptr %size_at
  %over = icmp ugt i64 %end, %most
  br i1 %over, label %none, label %made
made:
  store i64 %end, ptr %space
  %start = getelementptr i8, ptr %space, i64 %used
  store i64 %k, ptr %start
  %block = getelementptr i64, ptr %start, i64 2
  ret ptr %block
none:
  ret ptr null
}

define void @free(ptr %block) noinline {
  %space = call ptr @thread_space()
  %start = getelementptr i64, ptr %block, i64 -2
  %k = load i64, ptr %start
  %head = getelementptr i64, ptr %space, i64 %k
  %before = load ptr, ptr %head
  store ptr %before, ptr %block
  store ptr %block, ptr %head
  ret void
}

define void @empty_space(ptr %space) noinline {
entry:
  store i64 512, ptr %space
  br label %next
next:
  %k = phi i64 [ 3, %entry ], [ %after, %next ]
  %head = getelementptr i64, ptr %space, i64 %k
  store i64 0, ptr %head
  %after = add i64 %k, 1
  %all = icmp eq i64 %after, 64
  br i1 %all, label %done, label %next
done:
  ret void
}
"""
_QUEUE = """
declare ptr @thread_space()
declare i64 @thread_clock()
declare void @empty_space(ptr)
declare i32 @{entry}(ptr, ptr, ptr)
declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)

define void @work_on(ptr %job) alwaysinline {{
entry:
  %given = alloca [64 x i64]
  %room = alloca [8 x i64]
  %error = alloca i64
  %next = getelementptr i64, ptr %job, i64 1
  %rows_at = getelementptr i64, ptr %job, i64 2
  %row_bytes_at = getelementptr i64, ptr %job, i64 3
  %answers_at = getelementptr i64, ptr %job, i64 4
  %answer_bytes_at = getelementptr i64, ptr %job, i64 5
  %size_at = getelementptr i64, ptr %job, i64 7
  %begin_at = getelementptr i64, ptr %job, i64 8
  %end_at = getelementptr i64, ptr %job, i64 9
  %numbers_at = getelementptr i64, ptr %job, i64 10
  %numbers = getelementptr i64, ptr %job, i64 11
  %n = load i64, ptr %job
  %rows = load i64, ptr %rows_at
  %row_bytes = load i64, ptr %row_bytes_at
  %answers = load i64, ptr %answers_at
  %answer_bytes = load i64, ptr %answer_bytes_at
  %size = load i64, ptr %size_at
  %begin_for = load i64, ptr %begin_at
  %end_after = load i64, ptr %end_at
  %count = load i64, ptr %numbers_at
  %bytes = shl i64 %count, 3
  call void @llvm.memcpy.p0.p0.i64(ptr %given, ptr %numbers, i64 %bytes, i1 false)
  %row_place = getelementptr i64, ptr %given, i64 {rows_at}
  %answer_place = getelementptr i64, ptr %given, i64 {answers_at}
  %start = call i64 @thread_clock()
  %last_begin = add i64 %start, %begin_for
  %closes = add i64 %start, %end_after
  %space = call ptr @thread_space()
  %space_size = getelementptr i64, ptr %space, i64 1
  store i64 %size, ptr %space_size
  %closing = getelementptr i64, ptr %space, i64 2
  store i64 %closes, ptr %closing
  call void @empty_space(ptr %space)
  br label %again
again:
  %now = call i64 @thread_clock()
  %late = icmp ugt i64 %now, %last_begin
  br i1 %late, label %done, label %take
take:
  %i = atomicrmw add ptr %next, i64 1 monotonic
  %is_one = icmp ult i64 %i, %n
  br i1 %is_one, label %work, label %done
work:
  %row_offset = mul i64 %i, %row_bytes
  %row = add i64 %rows, %row_offset
  store i64 %row, ptr %row_place
  %answer_offset = mul i64 %i, %answer_bytes
  %answer = add i64 %answers, %answer_offset
  store i64 %answer, ptr %answer_place
  %failed = call i32 @{entry}(ptr %given, ptr %room, ptr %error)
  %is_whole = icmp eq i32 %failed, 0
  br i1 %is_whole, label %again, label %anew
anew:
  call void @empty_space(ptr %space)
  br label %again
done:
  ret void
}}
"""
_ON_CARD = """
@job_of_all = global ptr null
declare i32 @llvm.nvvm.read.ptx.sreg.tid.x()
declare i32 @llvm.nvvm.read.ptx.sreg.ctaid.x()
declare i32 @llvm.nvvm.read.ptx.sreg.ntid.x()
declare i64 @llvm.nvvm.read.ptx.sreg.clock64()
declare void @work_on(ptr)

define i64 @thread_clock() alwaysinline {
  %now = call i64 @llvm.nvvm.read.ptx.sreg.clock64()
  ret i64 %now
}

define ptr @thread_space() alwaysinline {
  %thread = call i32 @llvm.nvvm.read.ptx.sreg.tid.x()
  %block = call i32 @llvm.nvvm.read.ptx.sreg.ctaid.x()
  %threads = call i32 @llvm.nvvm.read.ptx.sreg.ntid.x()
  %before = mul i32 %block, %threads
  %narrow = add i32 %before, %thread
  %number = zext i32 %narrow to i64
  %job = load ptr, ptr @job_of_all
  %spaces_at = getelementptr i64, ptr %job, i64 6
  %spaces = load ptr, ptr %spaces_at
  %size_at = getelementptr i64, ptr %job, i64 7
  %size = load i64, ptr %size_at
  %offset = mul i64 %number, %size
  %space = getelementptr i8, ptr %spaces, i64 %offset
  ret ptr %space
}

define ptx_kernel void @queue(ptr %job) {
  store ptr %job, ptr @job_of_all
  call void @work_on(ptr %job)
  ret void
}
"""
_ON_PROCESSOR = """
@space_of_thread = thread_local global ptr null
declare void @work_on(ptr)

define i64 @thread_clock() alwaysinline {
  ret i64 1
}

define ptr @thread_space() alwaysinline {
  %space = load ptr, ptr @space_of_thread
  ret ptr %space
}

define void @queue(ptr %job, i64 %number) {
  %spaces_at = getelementptr i64, ptr %job, i64 6
  %spaces = load ptr, ptr %spaces_at
  %size_at = getelementptr i64, ptr %job, i64 7
  %size = load i64, ptr %size_at
  %offset = mul i64 %number, %size
  %space = getelementptr i8, ptr %spaces, i64 %offset
  store ptr %space, ptr @space_of_thread
  call void @work_on(ptr %job)
  ret void
}
"""
"""On a processor, whose clock stands still, a thread is told its number: so tests run the queue."""


def of_queue(entry: str, *, on_card: bool) -> tuple[str, str, str]:
    """Return the code of threads that have an entry work, on a card or a processor; its symbol is `queue`."""
    queue = _QUEUE.format(entry=entry, rows_at=ROWS_AT, answers_at=ANSWERS_AT)
    return _MEMORY, queue, _ON_CARD if on_card else _ON_PROCESSOR
