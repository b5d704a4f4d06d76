! Describes Fortran arrays to the C ABI, in place: the strides are the distances of neighbouring elements, so a section
! of a larger array, also one that runs backwards, needs no copy. The dummies are assumed-rank and never contiguous:
! a contiguous one would get a temporary that dies on return, while the library still borrows it.
module tetlod_arrays
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_intptr_t, c_loc, c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use tetlod_types, only: tetlod_array, TETLOD_FLOAT32, TETLOD_FLOAT64, TETLOD_INT32, TETLOD_INT64, TETLOD_UINT8
  implicit none
  private
  public :: array_of, empty_array

  ! Of an array (n): n tuples of one component; of an array (k, n): n tuples of k components; of another rank, none,
  ! which the library refuses.
  interface array_of
    module procedure r32_array, r64_array, i8_array, i32_array, i64_array
  end interface

contains

  ! To be filled by the library.
  pure function empty_array() result(array)
    type(tetlod_array) :: array
    array%struct_size = int(c_sizeof(array), c_int32_t)
  end function

  ! Bytes from one element to the next. A dimension of one element has no next: 0, which the library reads as packed.
  function distance(from, to) result(bytes)
    type(c_ptr), intent(in) :: from, to
    integer(c_int64_t) :: bytes
    bytes = int(transfer(to, 0_c_intptr_t) - transfer(from, 0_c_intptr_t), c_int64_t)
  end function

  ! extents: of the array. ends: the first element, the next component, the next tuple; null without elements.
  function described(type, extents, ends) result(array)
    integer(c_int32_t), intent(in) :: type
    integer(c_int64_t), intent(in) :: extents(:)
    type(c_ptr), intent(in) :: ends(3)
    type(tetlod_array) :: array
    array = empty_array()
    array%type = type
    array%data = ends(1)
    array%component_stride = distance(ends(1), ends(2))
    array%tuple_stride = distance(ends(1), ends(3))
    if (size(extents) == 1) then
      array%components = 1
      array%tuples = extents(1)
    else if (size(extents) == 2) then
      array%components = int(min(extents(1), int(huge(0_c_int32_t), c_int64_t)), c_int32_t)
      array%tuples = extents(2)
    end if
  end function

  ! The number of the second element, or of the only one. Where gfortran has made a temporary of what it is given, the
  ! first one's is not 1.
  pure function second(first, extent)
    integer(c_int64_t), intent(in) :: first, extent
    integer(c_int64_t) :: second
    second = first + min(1_c_int64_t, extent - 1)
  end function

  function r32_array(a) result(array)
    real(real32), intent(in), target :: a(..)
    type(tetlod_array) :: array
    type(c_ptr) :: ends(3)
    integer(c_int64_t) :: n(rank(a)), b(rank(a))
    n = shape(a, kind=c_int64_t)
    ends = c_null_ptr
    select rank (a)
    rank (1)
      b = lbound(a, kind=c_int64_t)
      if (n(1) > 0) ends = [c_loc(a(b(1))), c_loc(a(b(1))), c_loc(a(second(b(1), n(1))))]
    rank (2)
      b = lbound(a, kind=c_int64_t)
      if (all(n > 0)) ends = [c_loc(a(b(1), b(2))), c_loc(a(second(b(1), n(1)), b(2))), &
                              c_loc(a(b(1), second(b(2), n(2))))]
    end select
    array = described(TETLOD_FLOAT32, n, ends)
  end function

  function r64_array(a) result(array)
    real(real64), intent(in), target :: a(..)
    type(tetlod_array) :: array
    type(c_ptr) :: ends(3)
    integer(c_int64_t) :: n(rank(a)), b(rank(a))
    n = shape(a, kind=c_int64_t)
    ends = c_null_ptr
    select rank (a)
    rank (1)
      b = lbound(a, kind=c_int64_t)
      if (n(1) > 0) ends = [c_loc(a(b(1))), c_loc(a(b(1))), c_loc(a(second(b(1), n(1))))]
    rank (2)
      b = lbound(a, kind=c_int64_t)
      if (all(n > 0)) ends = [c_loc(a(b(1), b(2))), c_loc(a(second(b(1), n(1)), b(2))), &
                              c_loc(a(b(1), second(b(2), n(2))))]
    end select
    array = described(TETLOD_FLOAT64, n, ends)
  end function

  function i8_array(a) result(array)
    integer(int8), intent(in), target :: a(..)
    type(tetlod_array) :: array
    type(c_ptr) :: ends(3)
    integer(c_int64_t) :: n(rank(a)), b(rank(a))
    n = shape(a, kind=c_int64_t)
    ends = c_null_ptr
    select rank (a)
    rank (1)
      b = lbound(a, kind=c_int64_t)
      if (n(1) > 0) ends = [c_loc(a(b(1))), c_loc(a(b(1))), c_loc(a(second(b(1), n(1))))]
    rank (2)
      b = lbound(a, kind=c_int64_t)
      if (all(n > 0)) ends = [c_loc(a(b(1), b(2))), c_loc(a(second(b(1), n(1)), b(2))), &
                              c_loc(a(b(1), second(b(2), n(2))))]
    end select
    array = described(TETLOD_UINT8, n, ends)
  end function

  function i32_array(a) result(array)
    integer(int32), intent(in), target :: a(..)
    type(tetlod_array) :: array
    type(c_ptr) :: ends(3)
    integer(c_int64_t) :: n(rank(a)), b(rank(a))
    n = shape(a, kind=c_int64_t)
    ends = c_null_ptr
    select rank (a)
    rank (1)
      b = lbound(a, kind=c_int64_t)
      if (n(1) > 0) ends = [c_loc(a(b(1))), c_loc(a(b(1))), c_loc(a(second(b(1), n(1))))]
    rank (2)
      b = lbound(a, kind=c_int64_t)
      if (all(n > 0)) ends = [c_loc(a(b(1), b(2))), c_loc(a(second(b(1), n(1)), b(2))), &
                              c_loc(a(b(1), second(b(2), n(2))))]
    end select
    array = described(TETLOD_INT32, n, ends)
  end function

  function i64_array(a) result(array)
    integer(int64), intent(in), target :: a(..)
    type(tetlod_array) :: array
    type(c_ptr) :: ends(3)
    integer(c_int64_t) :: n(rank(a)), b(rank(a))
    n = shape(a, kind=c_int64_t)
    ends = c_null_ptr
    select rank (a)
    rank (1)
      b = lbound(a, kind=c_int64_t)
      if (n(1) > 0) ends = [c_loc(a(b(1))), c_loc(a(b(1))), c_loc(a(second(b(1), n(1))))]
    rank (2)
      b = lbound(a, kind=c_int64_t)
      if (all(n > 0)) ends = [c_loc(a(b(1), b(2))), c_loc(a(second(b(1), n(1)), b(2))), &
                              c_loc(a(b(1), second(b(2), n(2))))]
    end select
    array = described(TETLOD_INT64, n, ends)
  end function
end module
