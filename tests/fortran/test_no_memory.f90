! Where Fortran has no memory for what it is to hold, the module tells by stat and errmsg, and leaves nothing allocated.
program test_no_memory
  use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
  use, intrinsic :: iso_fortran_env, only: int64
  use tetlod
  implicit none
  integer(c_int), parameter :: address_space = 9  ! as Linux numbers it
  integer(int64), allocatable :: counts(:)
  integer(c_int64_t) :: limits(2)
  integer :: stat
  character(len=80) :: message
  type(tetlod_context) :: lod

  interface
    function getrlimit(resource, limits) result(failed) bind(C)
      import :: c_int, c_int64_t
      integer(c_int), value :: resource
      integer(c_int64_t), intent(out) :: limits(2)
      integer(c_int) :: failed
    end function
    function setrlimit(resource, limits) result(failed) bind(C)
      import :: c_int, c_int64_t
      integer(c_int), value :: resource
      integer(c_int64_t), intent(in) :: limits(2)
      integer(c_int) :: failed
    end function
  end interface

  stat = -1
  message = ""
  call lod%create()
  if (getrlimit(address_space, limits) /= 0) error stop "there is no limit"
  if (setrlimit(address_space, [1_c_int64_t, limits(2)]) /= 0) error stop "a limit is not set"
  call lod%histogram(0, 2**20, counts, stat, message)  ! 8 MB
  if (setrlimit(address_space, limits) /= 0) error stop "the limit stays"
  if (stat /= TETLOD_ERR_MEMORY) error stop "no memory is not told by stat"
  if (message /= "no memory for an array of 1048576 elements") error stop "no memory is not told by errmsg"
  if (allocated(counts)) error stop "something is allocated"
  call lod%histogram(0, 2**20, counts, stat, message)
  if (stat /= TETLOD_ERR_STATE) error stop "with memory it is the missing result that is told"
  call lod%destroy()
  print '("ok")'
end program
