! Texts across the border to C.
module tetlod_text
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_null_char, c_ptr, c_size_t
  implicit none
  private
  public :: c_text, fortran_text

  interface
    function c_strlen(text) result(length) bind(C, name="strlen")
      import
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function
  end interface

contains

  ! Without trailing blanks, with the zero that C asks for.
  pure function c_text(text) result(copy)
    character(len=*), intent(in) :: text
    character(kind=c_char) :: copy(len_trim(text) + 1)
    integer :: i
    do i = 1, size(copy) - 1
      copy(i) = text(i:i)
    end do
    copy(size(copy)) = c_null_char
  end function

  ! A copy; empty for NULL.
  function fortran_text(text) result(copy)
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: copy
    character(kind=c_char), pointer :: letters(:)
    integer :: i
    copy = ""
    if (.not. c_associated(text)) return
    call c_f_pointer(text, letters, [c_strlen(text)])
    copy = repeat(" ", size(letters))
    do i = 1, size(letters)
      copy(i:i) = letters(i)
    end do
  end function
end module
