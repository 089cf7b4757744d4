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
declare ptr @malloc(i64)

define ptr @NRT_room(i64 %size) {
  %block = call ptr @malloc(i64 %size)
  ret ptr %block
}
"""
"""Memory of a system's C library."""
_HEAP = """
@__heap_base = external global i8
@unused = internal global ptr @__heap_base
@given_back = internal global [32 x ptr] zeroinitializer
declare i32 @llvm.ctlz.i32(i32, i1)
declare i32 @llvm.wasm.memory.size.i32(i32)
declare i32 @llvm.wasm.memory.grow.i32(i32, i32)

define ptr @NRT_room(i64 %size) {
  %large = icmp ugt i64 %size, 2147483647
  br i1 %large, label %none, label %there
there:
  %length = trunc i64 %size to i32
  %block = call ptr @malloc(i32 %length)
  ret ptr %block
none:
  ret ptr null
}

define noalias ptr @malloc(i32 %size) noinline {
  %with = add i32 %size, 16
  %large = icmp ugt i32 %size, 2147483631
  br i1 %large, label %none, label %some
some:
  %zeros = call i32 @llvm.ctlz.i32(i32 %with, i1 false)
  %k = sub i32 32, %zeros
  %head = getelementptr ptr, ptr @given_back, i32 %k
  %kept = load ptr, ptr %head
  %fresh = icmp eq ptr %kept, null
  br i1 %fresh, label %cut, label %again
again:
  %before = load ptr, ptr %kept
  store ptr %before, ptr %head
  ret ptr %kept
cut:
  %start = load ptr, ptr @unused
  %first = ptrtoint ptr %start to i32
  %whole = shl i32 1, %k
  %end = add i32 %first, %whole
  %over = icmp ult i32 %end, %first
  br i1 %over, label %none, label %room
room:
  %last = sub i32 %end, 1
  %last_page = lshr i32 %last, 16
  %pages = call i32 @llvm.wasm.memory.size.i32(i32 0)
  %is_there = icmp ult i32 %last_page, %pages
  br i1 %is_there, label %made, label %grow
grow:
  %but_one = sub i32 %last_page, %pages
  %more = add i32 %but_one, 1
  %grown = call i32 @llvm.wasm.memory.grow.i32(i32 0, i32 %more)
  %refused = icmp eq i32 %grown, -1
  br i1 %refused, label %none, label %made
made:
  %next = inttoptr i32 %end to ptr
  store ptr %next, ptr @unused
  store i32 %k, ptr %start
  %block = getelementptr i8, ptr %start, i32 16
  ret ptr %block
none:
  ret ptr null
}

define void @free(ptr %block) noinline {
  %none = icmp eq ptr %block, null
  br i1 %none, label %done, label %there
there:
  %start = getelementptr i8, ptr %block, i32 -16
  %k = load i32, ptr %start
  %head = getelementptr ptr, ptr @given_back, i32 %k
  %before = load ptr, ptr %head
  store ptr %before, ptr %block
  store ptr %block, ptr %head
  br label %done
done:
  ret void
}
"""
"""Memory of a page, which has no C library: blocks of 2^k bytes, the first of which say k.

One that is given back is kept for the next that needs as many.
"""
_PRODUCT = """
define void @__multi3(ptr %product, i64 %a, i64 %a_high, i64 %b, i64 %b_high) noinline optnone {
  %a_0 = and i64 %a, 4294967295
  %a_1 = lshr i64 %a, 32
  %b_0 = and i64 %b, 4294967295
  %b_1 = lshr i64 %b, 32
  %p_00 = mul i64 %a_0, %b_0
  %p_01 = mul i64 %a_0, %b_1
  %p_10 = mul i64 %a_1, %b_0
  %p_11 = mul i64 %a_1, %b_1
  %carry_00 = lshr i64 %p_00, 32
  %low_01 = and i64 %p_01, 4294967295
  %low_10 = and i64 %p_10, 4294967295
  %two = add i64 %carry_00, %low_01
  %three = add i64 %two, %low_10
  %carry = lshr i64 %three, 32
  %high_01 = lshr i64 %p_01, 32
  %high_10 = lshr i64 %p_10, 32
  %a_b_high = mul i64 %a, %b_high
  %b_a_high = mul i64 %b, %a_high
  %sum_1 = add i64 %p_11, %carry
  %sum_2 = add i64 %sum_1, %high_01
  %sum_3 = add i64 %sum_2, %high_10
  %sum_4 = add i64 %sum_3, %a_b_high
  %high = add i64 %sum_4, %b_a_high
  %low = mul i64 %a, %b
  store i64 %low, ptr %product
  %high_at = getelementptr i64, ptr %product, i32 1
  store i64 %high, ptr %high_at
  ret void
}
"""
"""The product of integers of 128 bits, which LLVM calls where it asks whether one of 64 bits overflows."""
OF_RUNTIME = ("release", "malloc", "free", "__multi3")
"""The symbols of the runtime that others call, the last three of a page's."""


def of_runtime(*, is_narrow: bool) -> tuple[str, ...]:
    """Return the code for a system that counts bytes in 64 bits, or for a page, which does in 32."""
    return (_ARRAYS, _HEAP, _PRODUCT) if is_narrow else (_ARRAYS, _ROOM)
