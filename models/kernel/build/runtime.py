"""The part of numba's runtime that makes, counts and frees arrays, as LLVM's code, with numba's layout."""

_ARRAYS = """
declare ptr @NRT_room(i64)
declare void @free(ptr)

define noalias ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %align) noinline {
  %wide = zext i32 %align to i64
  %room = add i64 %wide, 48
  %whole = add i64 %room, %size
  %block = call ptr @NRT_room(i64 %whole)
  %none = icmp eq ptr %block, null
  br i1 %none, label %failed, label %made
made:
  %start = ptrtoint ptr %block to i64
  %last = add i64 %start, %room
  %over = urem i64 %last, %wide
  %data = sub i64 %last, %over
  store i64 1, ptr %block
  %dtor = getelementptr i64, ptr %block, i64 1
  store i64 0, ptr %dtor
  %info = getelementptr i64, ptr %block, i64 2
  store i64 0, ptr %info
  %place = getelementptr i64, ptr %block, i64 3
  store i64 %data, ptr %place
  %length = getelementptr i64, ptr %block, i64 4
  store i64 %size, ptr %length
  %allocator = getelementptr i64, ptr %block, i64 5
  store i64 0, ptr %allocator
  ret ptr %block
failed:
  ret ptr null
}

define void @NRT_MemInfo_call_dtor(ptr %block) noinline {
  call void @free(ptr %block)
  ret void
}

define ptr @NRT_MemInfo_data_fast(ptr %block) {
  %place = getelementptr i64, ptr %block, i32 3
  %address = load ptr, ptr %place
  ret ptr %address
}

define i64 @NRT_counted(ptr %block, i64 %more) {
  %none = icmp eq ptr %block, null
  br i1 %none, label %left, label %there
there:
  %before = load i64, ptr %block
  %after = add i64 %before, %more
  store i64 %after, ptr %block
  ret i64 %after
left:
  ret i64 1
}

define void @NRT_incref(ptr %block) {
  %count = call i64 @NRT_counted(ptr %block, i64 1)
  ret void
}

define void @NRT_decref(ptr %block) {
  %count = call i64 @NRT_counted(ptr %block, i64 -1)
  %unused = icmp eq i64 %count, 0
  br i1 %unused, label %freed, label %done
freed:
  call void @NRT_MemInfo_call_dtor(ptr %block)
  ret void
done:
  ret void
}

declare double @llvm.sqrt.f64(double)

define double @sqrt(double %x) alwaysinline {
  %root = call double @llvm.sqrt.f64(double %x)
  ret double %root
}

define void @release(ptr %block) {
  call void @NRT_decref(ptr %block)
  ret void
}
"""
"""An array belongs to one thread: its references are counted in its block's first eight bytes, unlocked.

Python calls `release` for an array that is returned to it. A root has one right answer.
"""
_ROOM = """
declare ptr @malloc({word})

define ptr @NRT_room(i64 %size) {{
{narrowed}
  %block = call ptr @malloc({word} %length)
  ret ptr %block
}}
"""


def of_runtime(*, is_narrow: bool) -> tuple[str, str]:
    """Return the code, for a C library that counts bytes in 32 bits or in 64."""
    word = "i32" if is_narrow else "i64"
    narrowed = "  %length = trunc i64 %size to i32" if is_narrow else "  %length = add i64 %size, 0"
    return _ARRAYS, _ROOM.format(word=word, narrowed=narrowed)
