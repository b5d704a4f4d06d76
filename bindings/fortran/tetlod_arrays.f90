! Describes Fortran arrays to the C ABI, in place: the strides are the distances of neighbouring elements, so a section
! of a larger array, also one that runs backwards, needs no copy. The dummies are pointers, which never get a temporary:
! that would die on return, while the library still borrows it. They bring their lower bounds with them.
! Given a component of an array of a derived type, gfortran passes that array's description: the elements would be those
! of the first component. A pointer is not associated with its own section then, by which such an array is known here.
module tetlod_arrays
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_intptr_t, c_loc, c_null_ptr, c_ptr, &
    c_associated, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use tetlod_types, only: tetlod_array, TETLOD_FLOAT32, TETLOD_FLOAT64, TETLOD_INT32, TETLOD_INT64, TETLOD_UINT8
  implicit none
  private
  public :: array_of, empty_array, is_in_place

  ! Of an array (n): n tuples of one component; of an array (k, n): n tuples of k components.
  interface array_of
    module procedure r32_values, r32_tuples, r64_values, r64_tuples, &
      i8_values, i32_values, i32_tuples, i64_values, i64_tuples
  end interface

contains

  ! To be filled by the library.
  pure function empty_array() result(array)
    type(tetlod_array) :: array
    array%struct_size = int(c_sizeof(array), c_int32_t)
  end function

  ! Whether array_of could describe it: not a null pointer, nor an array that the compiler passes as another one.
  elemental function is_in_place(array)
    type(tetlod_array), intent(in) :: array
    logical :: is_in_place
    is_in_place = array%tuples == 0 .or. array%components == 0 .or. c_associated(array%data)
  end function

  ! Bytes from one element to the next. A dimension of one element has no next: 0, which the library reads as packed.
  function distance(from, to) result(bytes)
    type(c_ptr), intent(in) :: from, to
    integer(c_int64_t) :: bytes
    bytes = int(transfer(to, 0_c_intptr_t) - transfer(from, 0_c_intptr_t), c_int64_t)
  end function

  function described(type, components, tuples, first, next_component, next_tuple) result(array)
    integer(c_int32_t), intent(in) :: type
    integer(c_int64_t), intent(in) :: components, tuples
    type(c_ptr), intent(in) :: first, next_component, next_tuple
    type(tetlod_array) :: array
    array = shaped(type, components, tuples)
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

  ! What C refuses, as it does a null pointer.
  function nowhere(type) result(array)
    integer(c_int32_t), intent(in) :: type
    type(tetlod_array) :: array
    array = shaped(type, 1_c_int64_t, 1_c_int64_t)
  end function

  function r32_values(a) result(array)
    real(real32), pointer, intent(in) :: a(:)
    type(tetlod_array) :: array
    integer(c_int64_t) :: n, i
    array = nowhere(TETLOD_FLOAT32)
    if (.not. associated(a)) return
    n = size(a, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    if (n == 0) array = shaped(TETLOD_FLOAT32, 1_c_int64_t, n)
    if (associated(a, a(:))) array = described(TETLOD_FLOAT32, 1_c_int64_t, n, c_loc(a(i)), c_loc(a(i)), &
      c_loc(a(min(i + 1, i + n - 1))))
  end function

  function r32_tuples(a) result(array)
    real(real32), pointer, intent(in) :: a(:, :)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n, i, j
    array = nowhere(TETLOD_FLOAT32)
    if (.not. associated(a)) return
    k = size(a, 1, kind=c_int64_t)
    n = size(a, 2, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    j = lbound(a, 2, kind=c_int64_t)
    if (k == 0 .or. n == 0) array = shaped(TETLOD_FLOAT32, k, n)
    if (associated(a, a(:, :))) array = described(TETLOD_FLOAT32, k, n, c_loc(a(i, j)), &
      c_loc(a(min(i + 1, i + k - 1), j)), c_loc(a(i, min(j + 1, j + n - 1))))
  end function

  function r64_values(a) result(array)
    real(real64), pointer, intent(in) :: a(:)
    type(tetlod_array) :: array
    integer(c_int64_t) :: n, i
    array = nowhere(TETLOD_FLOAT64)
    if (.not. associated(a)) return
    n = size(a, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    if (n == 0) array = shaped(TETLOD_FLOAT64, 1_c_int64_t, n)
    if (associated(a, a(:))) array = described(TETLOD_FLOAT64, 1_c_int64_t, n, c_loc(a(i)), c_loc(a(i)), &
      c_loc(a(min(i + 1, i + n - 1))))
  end function

  function r64_tuples(a) result(array)
    real(real64), pointer, intent(in) :: a(:, :)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n, i, j
    array = nowhere(TETLOD_FLOAT64)
    if (.not. associated(a)) return
    k = size(a, 1, kind=c_int64_t)
    n = size(a, 2, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    j = lbound(a, 2, kind=c_int64_t)
    if (k == 0 .or. n == 0) array = shaped(TETLOD_FLOAT64, k, n)
    if (associated(a, a(:, :))) array = described(TETLOD_FLOAT64, k, n, c_loc(a(i, j)), &
      c_loc(a(min(i + 1, i + k - 1), j)), c_loc(a(i, min(j + 1, j + n - 1))))
  end function

  function i8_values(a) result(array)
    integer(int8), pointer, intent(in) :: a(:)
    type(tetlod_array) :: array
    integer(c_int64_t) :: n, i
    array = nowhere(TETLOD_UINT8)
    if (.not. associated(a)) return
    n = size(a, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    if (n == 0) array = shaped(TETLOD_UINT8, 1_c_int64_t, n)
    if (associated(a, a(:))) array = described(TETLOD_UINT8, 1_c_int64_t, n, c_loc(a(i)), c_loc(a(i)), &
      c_loc(a(min(i + 1, i + n - 1))))
  end function

  function i32_values(a) result(array)
    integer(int32), pointer, intent(in) :: a(:)
    type(tetlod_array) :: array
    integer(c_int64_t) :: n, i
    array = nowhere(TETLOD_INT32)
    if (.not. associated(a)) return
    n = size(a, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    if (n == 0) array = shaped(TETLOD_INT32, 1_c_int64_t, n)
    if (associated(a, a(:))) array = described(TETLOD_INT32, 1_c_int64_t, n, c_loc(a(i)), c_loc(a(i)), &
      c_loc(a(min(i + 1, i + n - 1))))
  end function

  function i32_tuples(a) result(array)
    integer(int32), pointer, intent(in) :: a(:, :)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n, i, j
    array = nowhere(TETLOD_INT32)
    if (.not. associated(a)) return
    k = size(a, 1, kind=c_int64_t)
    n = size(a, 2, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    j = lbound(a, 2, kind=c_int64_t)
    if (k == 0 .or. n == 0) array = shaped(TETLOD_INT32, k, n)
    if (associated(a, a(:, :))) array = described(TETLOD_INT32, k, n, c_loc(a(i, j)), &
      c_loc(a(min(i + 1, i + k - 1), j)), c_loc(a(i, min(j + 1, j + n - 1))))
  end function

  function i64_values(a) result(array)
    integer(int64), pointer, intent(in) :: a(:)
    type(tetlod_array) :: array
    integer(c_int64_t) :: n, i
    array = nowhere(TETLOD_INT64)
    if (.not. associated(a)) return
    n = size(a, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    if (n == 0) array = shaped(TETLOD_INT64, 1_c_int64_t, n)
    if (associated(a, a(:))) array = described(TETLOD_INT64, 1_c_int64_t, n, c_loc(a(i)), c_loc(a(i)), &
      c_loc(a(min(i + 1, i + n - 1))))
  end function

  function i64_tuples(a) result(array)
    integer(int64), pointer, intent(in) :: a(:, :)
    type(tetlod_array) :: array
    integer(c_int64_t) :: k, n, i, j
    array = nowhere(TETLOD_INT64)
    if (.not. associated(a)) return
    k = size(a, 1, kind=c_int64_t)
    n = size(a, 2, kind=c_int64_t)
    i = lbound(a, 1, kind=c_int64_t)
    j = lbound(a, 2, kind=c_int64_t)
    if (k == 0 .or. n == 0) array = shaped(TETLOD_INT64, k, n)
    if (associated(a, a(:, :))) array = described(TETLOD_INT64, k, n, c_loc(a(i, j)), &
      c_loc(a(min(i + 1, i + k - 1), j)), c_loc(a(i, min(j + 1, j + n - 1))))
  end function
end module
