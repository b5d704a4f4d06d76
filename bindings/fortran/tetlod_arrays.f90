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

  function described(shape, first, next_component, next_tuple) result(array)
    type(tetlod_array), intent(in) :: shape
    type(c_ptr), intent(in) :: first, next_component, next_tuple
    type(tetlod_array) :: array
    array = shape
    array%component_stride = distance(first, next_component)
    array%tuple_stride = distance(first, next_tuple)
    array%data = first
  end function

  ! Without elements: there is no address to give.
  function shaped(type, components, tuples) result(array)
    integer(c_int32_t), intent(in) :: type
    integer(c_int64_t), intent(in) :: components, tuples
    type(tetlod_array) :: array
    array = empty_array()
    array%type = type
    array%components = int(min(components, int(huge(0_c_int32_t), c_int64_t)), c_int32_t)
    array%tuples = tuples
    array%data = c_null_ptr
  end function

  function r32_array(a) result(array)
    real(real32), intent(in), target :: a(..)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n
    array = shaped(TETLOD_FLOAT32, 0_c_int64_t, 0_c_int64_t)
    select rank (a)
    rank (1)
      n = size(a, kind=c_int64_t)
      array = shaped(TETLOD_FLOAT32, 1_c_int64_t, n)
      if (n > 0) array = described(array, c_loc(a(1)), c_loc(a(1)), c_loc(a(min(2_c_int64_t, n))))
    rank (2)
      k = size(a, 1, kind=c_int64_t)
      n = size(a, 2, kind=c_int64_t)
      array = shaped(TETLOD_FLOAT32, k, n)
      if (k > 0 .and. n > 0) array = described(array, c_loc(a(1, 1)), c_loc(a(min(2_c_int64_t, k), 1)), &
        c_loc(a(1, min(2_c_int64_t, n))))
    end select
  end function

  function r64_array(a) result(array)
    real(real64), intent(in), target :: a(..)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n
    array = shaped(TETLOD_FLOAT64, 0_c_int64_t, 0_c_int64_t)
    select rank (a)
    rank (1)
      n = size(a, kind=c_int64_t)
      array = shaped(TETLOD_FLOAT64, 1_c_int64_t, n)
      if (n > 0) array = described(array, c_loc(a(1)), c_loc(a(1)), c_loc(a(min(2_c_int64_t, n))))
    rank (2)
      k = size(a, 1, kind=c_int64_t)
      n = size(a, 2, kind=c_int64_t)
      array = shaped(TETLOD_FLOAT64, k, n)
      if (k > 0 .and. n > 0) array = described(array, c_loc(a(1, 1)), c_loc(a(min(2_c_int64_t, k), 1)), &
        c_loc(a(1, min(2_c_int64_t, n))))
    end select
  end function

  function i8_array(a) result(array)
    integer(int8), intent(in), target :: a(..)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n
    array = shaped(TETLOD_UINT8, 0_c_int64_t, 0_c_int64_t)
    select rank (a)
    rank (1)
      n = size(a, kind=c_int64_t)
      array = shaped(TETLOD_UINT8, 1_c_int64_t, n)
      if (n > 0) array = described(array, c_loc(a(1)), c_loc(a(1)), c_loc(a(min(2_c_int64_t, n))))
    rank (2)
      k = size(a, 1, kind=c_int64_t)
      n = size(a, 2, kind=c_int64_t)
      array = shaped(TETLOD_UINT8, k, n)
      if (k > 0 .and. n > 0) array = described(array, c_loc(a(1, 1)), c_loc(a(min(2_c_int64_t, k), 1)), &
        c_loc(a(1, min(2_c_int64_t, n))))
    end select
  end function

  function i32_array(a) result(array)
    integer(int32), intent(in), target :: a(..)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n
    array = shaped(TETLOD_INT32, 0_c_int64_t, 0_c_int64_t)
    select rank (a)
    rank (1)
      n = size(a, kind=c_int64_t)
      array = shaped(TETLOD_INT32, 1_c_int64_t, n)
      if (n > 0) array = described(array, c_loc(a(1)), c_loc(a(1)), c_loc(a(min(2_c_int64_t, n))))
    rank (2)
      k = size(a, 1, kind=c_int64_t)
      n = size(a, 2, kind=c_int64_t)
      array = shaped(TETLOD_INT32, k, n)
      if (k > 0 .and. n > 0) array = described(array, c_loc(a(1, 1)), c_loc(a(min(2_c_int64_t, k), 1)), &
        c_loc(a(1, min(2_c_int64_t, n))))
    end select
  end function

  function i64_array(a) result(array)
    integer(int64), intent(in), target :: a(..)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n
    array = shaped(TETLOD_INT64, 0_c_int64_t, 0_c_int64_t)
    select rank (a)
    rank (1)
      n = size(a, kind=c_int64_t)
      array = shaped(TETLOD_INT64, 1_c_int64_t, n)
      if (n > 0) array = described(array, c_loc(a(1)), c_loc(a(1)), c_loc(a(min(2_c_int64_t, n))))
    rank (2)
      k = size(a, 1, kind=c_int64_t)
      n = size(a, 2, kind=c_int64_t)
      array = shaped(TETLOD_INT64, k, n)
      if (k > 0 .and. n > 0) array = described(array, c_loc(a(1, 1)), c_loc(a(min(2_c_int64_t, k), 1)), &
        c_loc(a(1, min(2_c_int64_t, n))))
    end select
  end function
end module
