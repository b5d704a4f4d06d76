! Sections of arrays of every kind and rank, also backward ones, are read and written as packed arrays are.
module sections_tests
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use test_box
  use tetlod
  implicit none
  integer, allocatable :: numbers(:, :)

contains

  ! Small ones, which every kind holds: means of them are none of -99.
  subroutine make_numbers()
    integer :: i
    allocate (numbers(2, size(xyz, 2)))
    do i = 1, size(numbers, 2)
      numbers(:, i) = [mod(i, 100), 100 - mod(7 * i, 100)]
    end do
  end subroutine

  subroutine test_r32(lod, n)
    type(tetlod_context), intent(inout) :: lod
    integer, intent(in) :: n
    real(real32), allocatable, target :: packed(:, :), wide(:, :), small(:, :), wide_small(:, :)
    allocate (packed, source=real(numbers, real32))
    allocate (wide(5, 2 * size(xyz, 2)), wide_small(5, 3 * n), source=-99.0)
    allocate (small(2, n))
    wide(4:2:-2, ::2) = packed
    call lod%transfer(packed, small)
    call lod%transfer(wide(4:2:-2, ::2), wide_small(1:3:2, 3 * n:1:-3))
    call expect(all(abs(wide_small(1:3:2, 3 * n:1:-3) - small) < tiny(small)), "sections (k, n) of real32")
    call lod%transfer(wide(2, ::2), wide_small(5, 2::3))
    call expect(all(abs(wide_small(5, 2::3) - small(2, :)) < tiny(small)), "sections (n) of real32")
    call expect(count(nint(wide_small) == -99) == size(wide_small) - 3 * n, "all else is left alone, real32")
  end subroutine

  subroutine test_r64(lod, n)
    type(tetlod_context), intent(inout) :: lod
    integer, intent(in) :: n
    real(real64), allocatable, target :: packed(:, :), wide(:, :), small(:, :), wide_small(:, :)
    allocate (packed, source=real(numbers, real64))
    allocate (wide(5, 2 * size(xyz, 2)), wide_small(5, 3 * n), source=-99d0)
    allocate (small(2, n))
    wide(4:2:-2, ::2) = packed
    call lod%transfer(packed, small)
    call lod%transfer(wide(4:2:-2, ::2), wide_small(1:3:2, 3 * n:1:-3))
    call expect(all(abs(wide_small(1:3:2, 3 * n:1:-3) - small) < tiny(small)), "sections (k, n) of real64")
    call lod%transfer(wide(2, ::2), wide_small(5, 2::3))
    call expect(all(abs(wide_small(5, 2::3) - small(2, :)) < tiny(small)), "sections (n) of real64")
    call expect(count(nint(wide_small) == -99) == size(wide_small) - 3 * n, "all else is left alone, real64")
  end subroutine

  subroutine test_i8(lod, n)
    type(tetlod_context), intent(inout) :: lod
    integer, intent(in) :: n
    integer(int8), allocatable, target :: packed(:, :), wide(:, :), small(:, :), wide_small(:, :)
    allocate (packed, source=int(numbers, int8))
    allocate (wide(5, 2 * size(xyz, 2)), wide_small(5, 3 * n), source=-99_int8)
    allocate (small(2, n))
    wide(4:2:-2, ::2) = packed
    call lod%transfer(packed, small)
    call lod%transfer(wide(4:2:-2, ::2), wide_small(1:3:2, 3 * n:1:-3))
    call expect(all(wide_small(1:3:2, 3 * n:1:-3) == small), "sections (k, n) of int8")
    call lod%transfer(wide(2, ::2), wide_small(5, 2::3))
    call expect(all(wide_small(5, 2::3) == small(2, :)), "sections (n) of int8")
    call expect(count(wide_small == -99_int8) == size(wide_small) - 3 * n, "all else is left alone, int8")
  end subroutine

  subroutine test_i32(lod, n)
    type(tetlod_context), intent(inout) :: lod
    integer, intent(in) :: n
    integer(int32), allocatable, target :: packed(:, :), wide(:, :), small(:, :), wide_small(:, :)
    allocate (packed, source=int(numbers, int32))
    allocate (wide(5, 2 * size(xyz, 2)), wide_small(5, 3 * n), source=-99_int32)
    allocate (small(2, n))
    wide(4:2:-2, ::2) = packed
    call lod%transfer(packed, small)
    call lod%transfer(wide(4:2:-2, ::2), wide_small(1:3:2, 3 * n:1:-3))
    call expect(all(wide_small(1:3:2, 3 * n:1:-3) == small), "sections (k, n) of int32")
    call lod%transfer(wide(2, ::2), wide_small(5, 2::3))
    call expect(all(wide_small(5, 2::3) == small(2, :)), "sections (n) of int32")
    call expect(count(wide_small == -99_int32) == size(wide_small) - 3 * n, "all else is left alone, int32")
  end subroutine

  subroutine test_i64(lod, n)
    type(tetlod_context), intent(inout) :: lod
    integer, intent(in) :: n
    integer(int64), allocatable, target :: packed(:, :), wide(:, :), small(:, :), wide_small(:, :)
    allocate (packed, source=int(numbers, int64))
    allocate (wide(5, 2 * size(xyz, 2)), wide_small(5, 3 * n), source=-99_int64)
    allocate (small(2, n))
    wide(4:2:-2, ::2) = packed
    call lod%transfer(packed, small)
    call lod%transfer(wide(4:2:-2, ::2), wide_small(1:3:2, 3 * n:1:-3))
    call expect(all(wide_small(1:3:2, 3 * n:1:-3) == small), "sections (k, n) of int64")
    call lod%transfer(wide(2, ::2), wide_small(5, 2::3))
    call expect(all(wide_small(5, 2::3) == small(2, :)), "sections (n) of int64")
    call expect(count(wide_small == -99_int64) == size(wide_small) - 3 * n, "all else is left alone, int64")
  end subroutine
end module

program test_sections
  use sections_tests
  implicit none
  type(tetlod_context) :: lod
  integer :: n
  call make_mesh()
  call make_numbers()
  call lod%create()
  call submit_box(lod)
  call lod%run()
  call lod%fetch_counts(n)
  call test_r32(lod, n)
  call test_r64(lod, n)
  call test_i8(lod, n)
  call test_i32(lod, n)
  call test_i64(lod, n)
  call lod%destroy()
  if (failures > 0) error stop "sections of arrays are not what the module tetlod reads or writes"
  print '("ok")'
end program
